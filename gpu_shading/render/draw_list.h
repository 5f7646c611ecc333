#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "render/screen_view.h"
#include "render/view.h"

namespace gpu_shading {

struct Range {
  std::size_t first = 0;
  std::size_t count = 0;
};

// The uniform block View of slide.vert, std140.
struct ViewBlock {
  glm::vec4 x;
  glm::vec4 y;
  glm::vec4 z;
  glm::vec4 cut;
  glm::vec4 origin_high;
  glm::vec4 origin_low;
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
};

// A receiver on its tile and the casters before it.
struct ReceiverJob {
  std::size_t view = 0;
  Range casters;
  Range screens;  // of the list's screen draws
  Range tile;
  std::int32_t first_key = -1;  // where schedules are told apart: their keys' place
};

// A window and the surfaces behind it, in another view.
struct InteriorJob {
  ReceiverJob window;
  std::size_t behind_view = 0;
  std::vector<Range> surfaces;
};

// What the draws of one submission read, gathered here to be uploaded at once.
class DrawList {
 public:
  void clear();

  // All surfaces added to one view become one draw.
  std::size_t begin_surfaces() const { return indices_.size(); }
  void add_triangles(std::span<std::uint32_t const> indices);
  Range end_surfaces(std::size_t begin) const { return {begin, indices_.size() - begin}; }

  Range add_tile(std::span<glm::vec2 const> triangles);
  std::size_t add_view(View const& view, glm::dvec3 const& scene_origin);

  // For all surfaces of the scene, at this submission's direction of the sun. Needed where some
  // transmit.
  void set_shades(std::vector<Shade> shades) { shades_ = std::move(shades); }
  // Returns the place of the first.
  std::int32_t add_keys(std::span<glm::vec4 const> keys);

  // All screens added to one draw look alike.
  std::size_t begin_screens() const { return screen_indices_.size(); }
  void add_quadrilaterals(std::span<std::uint32_t const> indices);
  void end_screens(std::size_t begin, ScreenLook look);
  // Some view may see this screen's effect, one of `screens`.
  void add_effect(int screen, std::size_t screens);
  // By screen; too short, or false, where no view does.
  std::vector<bool> const& by_effect() const { return by_effect_; }
  // Needed where there are screens.
  void set_screen_view(ScreenView view) { screen_view_ = std::move(view); }

  std::span<std::uint32_t const> indices() const { return indices_; }
  std::span<glm::vec2 const> tile_vertices() const { return tile_vertices_; }
  std::span<ViewBlock const> views() const { return views_; }
  std::span<Shade const> shades() const { return shades_; }
  std::span<glm::vec4 const> keys() const { return keys_; }
  std::span<std::uint32_t const> screen_indices() const { return screen_indices_; }
  std::span<ScreenDraw const> screen_draws() const { return screen_draws_; }
  ScreenView const& screen_view() const { return screen_view_; }

 private:
  std::vector<std::uint32_t> indices_;
  std::vector<glm::vec2> tile_vertices_;
  std::vector<ViewBlock> views_;
  std::vector<Shade> shades_;
  std::vector<glm::vec4> keys_;
  std::vector<std::uint32_t> screen_indices_;
  std::vector<ScreenDraw> screen_draws_;
  std::vector<bool> by_effect_;
  ScreenView screen_view_;
};

}  // namespace gpu_shading
