#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "backends/opengl/gl/buffer.h"
#include "backends/opengl/gl/draw.h"
#include "backends/opengl/gl/vertex_array.h"
#include "filters/perforation/sheet_in_beam.h"
#include "filters/transmission.h"
#include "view/range.h"
#include "view/view.h"

namespace gpu_shading {

// The data of a view that slide.vert, transmit.vert and screen.vert read.
struct ViewRecord {
  glm::vec4 x;
  glm::vec4 y;
  glm::vec4 z;
  glm::vec4 cut;
  glm::vec4 origin_high;
  glm::vec4 origin_low;
  glm::ivec4 numbers;  // layer; first key or identity; first shade; first sheet
};

// The data of a tile that tile.vert reads.
struct TileVertex {
  glm::vec2 place;
  std::int32_t layer;
};

// Shade in the layout of transmit.vert, std430.
struct ShadeRecord {
  float transmittance = 0.0F;
  std::int32_t schedule = -1;
  float extinction = 0.0F;
};

// What screens must have in common to be drawn together.
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

// The entries of a draw list for one sun direction, with one table each for its shades and screens.
struct DirectionTables {
  ScreensAtDirection screens;
  std::size_t first_shade = 0;
};

// The data that the draws of one submission read, collected here to be uploaded at once: views,
// each on its own layer, for any sun directions.
class DrawList {
 public:
  void clear();

  // On a layer.
  void add_tile(std::span<glm::vec2 const> triangles, int layer);

  // Returns its index.
  std::uint32_t add_view(View const& view, glm::dvec3 const& scene_origin,
                         glm::ivec4 const& numbers);

  // All surfaces added to one draw use one view.
  std::size_t begin_surfaces() const { return indices_.size(); }
  void add_triangles(std::span<std::uint32_t const> indices);
  Range end_surfaces(std::size_t begin) const { return {begin, indices_.size() - begin}; }

  // Draws of casters in front of receivers and of surfaces behind windows, in separate order.
  void add_caster_draw(Range surfaces, std::uint32_t view);
  void add_interior_draw(Range surfaces, std::uint32_t view);

  // Tables for this many transmitting surfaces; views are added direction by direction.
  DirectionTables& tables(glm::dvec3 const& towards_sun, std::size_t surfaces);
  std::span<DirectionTables const> directions() const { return directions_; }
  bool knows_shade(std::size_t place) const { return known_shades_[place]; }
  void set_shade(std::size_t place, Shade const& shade);
  // Of a crown, per metre.
  void set_extinction(std::size_t place, double extinction) {
    shades_[place].extinction = static_cast<float>(extinction);
  }
  // Returns the index of the first.
  std::int32_t add_keys(std::span<glm::vec4 const> keys);

  // All screens added to one draw have the same look.
  std::size_t begin_screens() const { return screen_indices_.size(); }
  void add_quadrilaterals(std::span<std::uint32_t const> indices);
  void end_screens(std::size_t begin, ScreenLook look, std::uint32_t view);
  void add_crown_draw(std::span<std::uint32_t const> indices, std::uint32_t view);

  // For all directions, in order. Required if there are screens.
  void set_sheets(SheetBlocks sheets) { sheets_ = std::move(sheets); }

  std::span<TileVertex const> tile_vertices() const { return tile_vertices_; }
  std::span<ViewRecord const> views() const { return views_; }
  std::span<std::uint32_t const> indices() const { return indices_; }
  std::span<gl::Command const> caster_draws() const { return caster_draws_; }
  std::span<gl::Command const> interior_draws() const { return interior_draws_; }
  std::span<ShadeRecord const> shades() const { return shades_; }
  std::span<glm::vec4 const> keys() const { return keys_; }
  std::span<std::uint32_t const> screen_indices() const { return screen_indices_; }
  std::span<ScreenDraw const> screen_draws() const { return screen_draws_; }
  SheetBlocks const& sheets() const { return sheets_; }
  std::span<std::uint32_t const> crown_indices() const { return crown_indices_; }
  std::span<gl::Command const> crown_draws() const { return crown_draws_; }

  // Memory of all this, without the screens' data at each direction.
  std::size_t bytes() const;

 private:
  std::vector<TileVertex> tile_vertices_;
  std::vector<ViewRecord> views_;
  std::vector<std::uint32_t> indices_;
  std::vector<gl::Command> caster_draws_;
  std::vector<gl::Command> interior_draws_;
  std::vector<DirectionTables> directions_;
  std::vector<ShadeRecord> shades_;
  std::vector<bool> known_shades_;
  std::vector<glm::vec4> keys_;
  std::vector<std::uint32_t> screen_indices_;
  std::vector<ScreenDraw> screen_draws_;
  SheetBlocks sheets_;
  std::vector<std::uint32_t> crown_indices_;
  std::vector<gl::Command> crown_draws_;
};

// Adds views as an array's instance data; `views` holds ViewRecords.
void add_view_records(gl::VertexArray& array, gl::Buffer const& views);

}  // namespace gpu_shading
