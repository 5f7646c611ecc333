#include "backends/opengl/raster/draw_list.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "backends/opengl/raster/split_double.h"

namespace gpu_shading {

namespace {

gl::Command command(Range surfaces, std::uint32_t view) {
  return {.count = static_cast<std::uint32_t>(surfaces.count),
          .first = static_cast<std::uint32_t>(surfaces.first),
          .record = view};
}

template <typename T>
std::size_t bytes_of(std::vector<T> const& values) {
  return values.size() * sizeof(T);
}

}  // namespace

void DrawList::clear() {
  tile_vertices_.clear();
  views_.clear();
  indices_.clear();
  caster_draws_.clear();
  interior_draws_.clear();
  directions_.clear();
  shades_.clear();
  known_shades_.clear();
  keys_.clear();
  screen_indices_.clear();
  screen_draws_.clear();
  sheets_ = {};
  crown_indices_.clear();
  crown_draws_.clear();
}

void DrawList::add_tile(std::span<glm::vec2 const> triangles, int layer) {
  for (glm::vec2 const& place : triangles) tile_vertices_.push_back({place, layer});
}

std::uint32_t DrawList::add_view(View const& view, glm::dvec3 const& scene_origin,
                                 glm::ivec4 const& numbers) {
  SplitDouble const origin(view.origin - scene_origin);
  views_.push_back({glm::vec4(view.x), glm::vec4(view.y), glm::vec4(view.z), glm::vec4(view.cut),
                    glm::vec4(origin.high, 0.0F), glm::vec4(origin.low, 0.0F), numbers});
  return static_cast<std::uint32_t>(views_.size() - 1);
}

void DrawList::add_triangles(std::span<std::uint32_t const> indices) {
  indices_.insert(indices_.end(), indices.begin(), indices.end());
}

void DrawList::add_caster_draw(Range surfaces, std::uint32_t view) {
  if (surfaces.count > 0) caster_draws_.push_back(command(surfaces, view));
}

void DrawList::add_interior_draw(Range surfaces, std::uint32_t view) {
  if (surfaces.count > 0) interior_draws_.push_back(command(surfaces, view));
}

DirectionTables& DrawList::tables(glm::dvec3 const& towards_sun, std::size_t surfaces) {
  if (directions_.empty() || directions_.back().screens.towards_sun != towards_sun) {
    directions_.push_back({{towards_sun, {}, {}}, shades_.size()});
    shades_.resize(shades_.size() + surfaces);
    known_shades_.resize(shades_.size(), false);
  }
  return directions_.back();
}

void DrawList::set_shade(std::size_t place, Shade const& shade) {
  shades_[place].transmittance = shade.transmittance;
  shades_[place].schedule = shade.schedule;
  known_shades_[place] = true;
}

std::int32_t DrawList::add_keys(std::span<glm::vec4 const> keys) {
  auto const first = static_cast<std::int32_t>(keys_.size());
  keys_.insert(keys_.end(), keys.begin(), keys.end());
  return first;
}

void DrawList::add_quadrilaterals(std::span<std::uint32_t const> indices) {
  screen_indices_.insert(screen_indices_.end(), indices.begin(), indices.end());
}

void DrawList::end_screens(std::size_t begin, ScreenLook look, std::uint32_t view) {
  screen_draws_.push_back({look, {begin, screen_indices_.size() - begin}, view});
}

void DrawList::add_crown_draw(std::span<std::uint32_t const> indices, std::uint32_t view) {
  if (indices.empty()) return;
  Range const range{crown_indices_.size(), indices.size()};
  crown_indices_.insert(crown_indices_.end(), indices.begin(), indices.end());
  crown_draws_.push_back(command(range, view));
}

std::size_t DrawList::bytes() const {
  return bytes_of(tile_vertices_) + bytes_of(views_) + bytes_of(indices_) +
         bytes_of(caster_draws_) + bytes_of(interior_draws_) + bytes_of(shades_) + bytes_of(keys_) +
         bytes_of(screen_indices_) + bytes_of(screen_draws_) + bytes_of(crown_indices_) +
         bytes_of(crown_draws_);
}

void add_view_records(gl::VertexArray& array, gl::Buffer const& views) {
  constexpr std::array rows{offsetof(ViewRecord, x),           offsetof(ViewRecord, y),
                            offsetof(ViewRecord, z),           offsetof(ViewRecord, cut),
                            offsetof(ViewRecord, origin_high), offsetof(ViewRecord, origin_low)};
  // As in slide.vert.
  constexpr std::uint32_t first_row = 4;
  constexpr std::uint32_t numbers = 10;
  using Of = gl::VertexArray::Of;
  array.set_records(views, sizeof(ViewRecord));
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    array.add_floats(Of::records, first_row + row, 4, rows.at(row));
  }
  array.add_integers(Of::records, numbers, 4, offsetof(ViewRecord, numbers));
}

}  // namespace gpu_shading
