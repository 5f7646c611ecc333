#include "render/draw_list.h"

#include "render/twice_float.h"

namespace gpu_shading {

void DrawList::clear() {
  indices_.clear();
  tile_vertices_.clear();
  views_.clear();
  shades_.clear();
  keys_.clear();
  screen_indices_.clear();
  screen_draws_.clear();
  by_effect_.clear();
  screen_view_ = {};
}

void DrawList::add_triangles(std::span<std::uint32_t const> indices) {
  indices_.insert(indices_.end(), indices.begin(), indices.end());
}

Range DrawList::add_tile(std::span<glm::vec2 const> triangles) {
  Range const range{tile_vertices_.size(), triangles.size()};
  tile_vertices_.insert(tile_vertices_.end(), triangles.begin(), triangles.end());
  return range;
}

void DrawList::add_quadrilaterals(std::span<std::uint32_t const> indices) {
  screen_indices_.insert(screen_indices_.end(), indices.begin(), indices.end());
}

void DrawList::add_effect(int screen, std::size_t screens) {
  by_effect_.resize(screens, false);
  by_effect_[static_cast<std::size_t>(screen)] = true;
}

void DrawList::end_screens(std::size_t begin, ScreenLook look) {
  screen_draws_.push_back({look, {begin, screen_indices_.size() - begin}});
}

std::int32_t DrawList::add_keys(std::span<glm::vec4 const> keys) {
  auto const first = static_cast<std::int32_t>(keys_.size());
  keys_.insert(keys_.end(), keys.begin(), keys.end());
  return first;
}

std::size_t DrawList::add_view(View const& view, glm::dvec3 const& scene_origin) {
  TwiceFloat const origin(view.origin - scene_origin);
  views_.push_back({glm::vec4(view.x), glm::vec4(view.y), glm::vec4(view.z), glm::vec4(view.cut),
                    glm::vec4(origin.high, 0.0F), glm::vec4(origin.low, 0.0F)});
  return views_.size() - 1;
}

}  // namespace gpu_shading
