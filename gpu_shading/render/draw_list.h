#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "gl/draw.h"
#include "render/screen_view.h"
#include "render/view.h"

namespace gpu_shading {

struct Range {
  std::size_t first = 0;
  std::size_t count = 0;
};

// What slide.vert, transmit.vert and screen.vert read of a view.
struct ViewRecord {
  glm::vec4 x;
  glm::vec4 y;
  glm::vec4 z;
  glm::vec4 cut;
  glm::vec4 origin_high;
  glm::vec4 origin_low;
  glm::ivec4 numbers;  // layer; first key or identity; first shade; first sheet
};

// A tile's, of tile.vert.
struct TileVertex {
  glm::vec2 place;
  std::int32_t layer;
};

// A surface to transmit.vert, std430.
struct Shade {
  float transmittance = 0.0F;
  std::int32_t schedule = -1;
};

// What screens have to have in common to be drawn at once.
struct ScreenLook {
  int program = 0;
  int texture = -1;  // none

  bool operator<(ScreenLook const& other) const {
    return program != other.program ? program < other.program : texture < other.texture;
  }
};

struct ScreenDraw {
  ScreenLook look;
  Range indices;
  std::uint32_t record;
};

// What is in a draw list of one direction of the sun, of whose shades and screens there is a table
// each.
struct DirectionTables {
  glm::dvec3 towards_sun{0.0};
  std::size_t first_shade = 0;
  std::vector<bool> screens;    // by number, those in some view; none where too short
  std::vector<bool> by_effect;  // of these, whose effect some view may see

  void add_screen(int number, bool may_see_effect);
};

// What the draws of one submission read, gathered here to be uploaded at once: views, each on a
// layer of its own, of whatever directions of the sun.
class DrawList {
 public:
  void clear();

  // On a layer.
  void add_tile(std::span<glm::vec2 const> triangles, int layer);

  // Returns its number.
  std::uint32_t add_view(View const& view, glm::dvec3 const& scene_origin,
                         glm::ivec4 const& numbers);

  // All surfaces added to one draw are drawn by one view.
  std::size_t begin_surfaces() const { return indices_.size(); }
  void add_triangles(std::span<std::uint32_t const> indices);
  Range end_surfaces(std::size_t begin) const { return {begin, indices_.size() - begin}; }

  // What stands before receivers, and what lies behind windows: apart, each in its own order.
  void add_caster_draw(Range surfaces, std::uint32_t view);
  void add_interior_draw(Range surfaces, std::uint32_t view);

  // Tables for what transmits, of so many surfaces; views are added direction by direction.
  DirectionTables& tables(glm::dvec3 const& towards_sun, std::size_t surfaces);
  std::span<DirectionTables const> directions() const { return directions_; }
  bool knows_shade(std::size_t place) const { return known_shades_[place]; }
  void set_shade(std::size_t place, Shade shade);
  // Returns the place of the first.
  std::int32_t add_keys(std::span<glm::vec4 const> keys);

  // All screens added to one draw look alike.
  std::size_t begin_screens() const { return screen_indices_.size(); }
  void add_quadrilaterals(std::span<std::uint32_t const> indices);
  void end_screens(std::size_t begin, ScreenLook look, std::uint32_t view);
  // Of all directions, in their order. Needed where there are screens.
  void set_screen_view(ScreenView view) { screen_view_ = std::move(view); }

  std::span<TileVertex const> tile_vertices() const { return tile_vertices_; }
  std::span<ViewRecord const> views() const { return views_; }
  std::span<std::uint32_t const> indices() const { return indices_; }
  std::span<gl::Command const> caster_draws() const { return caster_draws_; }
  std::span<gl::Command const> interior_draws() const { return interior_draws_; }
  std::span<Shade const> shades() const { return shades_; }
  std::span<glm::vec4 const> keys() const { return keys_; }
  std::span<std::uint32_t const> screen_indices() const { return screen_indices_; }
  std::span<ScreenDraw const> screen_draws() const { return screen_draws_; }
  ScreenView const& screen_view() const { return screen_view_; }

  // Of all this, but for what screens are at the directions.
  std::size_t bytes() const;

 private:
  std::vector<TileVertex> tile_vertices_;
  std::vector<ViewRecord> views_;
  std::vector<std::uint32_t> indices_;
  std::vector<gl::Command> caster_draws_;
  std::vector<gl::Command> interior_draws_;
  std::vector<DirectionTables> directions_;
  std::vector<Shade> shades_;
  std::vector<bool> known_shades_;
  std::vector<glm::vec4> keys_;
  std::vector<std::uint32_t> screen_indices_;
  std::vector<ScreenDraw> screen_draws_;
  ScreenView screen_view_;
};

}  // namespace gpu_shading
