#include "view/blade_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "view/convex_area.h"
#include "view/nearest_whole.h"

namespace gpu_shading {
namespace {

glm::dvec2 in_tiles(View const& view, glm::dvec3 const& vector) {
  return 0.5 *
         glm::dvec2(glm::dot(glm::dvec3(view.x), vector), glm::dot(glm::dvec3(view.y), vector));
}

}  // namespace

std::optional<BladeSpectrum> BladeSpectrum::make(Repeat const& repeat, double share,
                                                 View const& view, OutlineSpectrum const& outline) {
  glm::dvec2 const step = in_tiles(view, repeat.step);
  glm::dvec2 const edge = in_tiles(view, repeat.edge);
  double const turn = cross(step, edge);
  constexpr double in_line = 1e-3;
  if (std::abs(turn) <= in_line * glm::length(step) * glm::length(edge)) return std::nullopt;
  // One cycle a step, none along the edge.
  glm::dvec2 const first = glm::dvec2(edge.y, -edge.x) / turn;
  constexpr double most_cycles = 1e9;
  if (!(glm::length(first) < most_cycles)) return std::nullopt;
  return BladeSpectrum(first, share, outline);
}

bool BladeSpectrum::merge(BladeSpectrum const& other) {
  constexpr double in_step = 0.1;
  if (std::min(glm::distance(first_, other.first_), glm::distance(first_, -other.first_)) > in_step)
    return false;
  share_ += other.share_;
  return true;
}

double BladeSpectrum::squared_error(TileGrid const& grid, double enough) const {
  // High multiples matter: the weaker they are, the closer some vector comes, until there are more
  // multiples than pixels.
  constexpr int most = 512;
  double const pixels = static_cast<double>(grid.width) * grid.rows;
  int const last = static_cast<int>(
      std::clamp(4.0 * pixels / glm::length(first_), double{strongest}, double{most}));
  double const amplitude = share_ / std::numbers::pi;
  double const wanted = enough / (amplitude * amplitude);
  double sum = 0.0;
  for (int multiple = 1; multiple <= strongest; ++multiple) sum += near_strong(grid, multiple);
  for (int from = strongest + 1; from <= last && sum < wanted; from += at_once) {
    sum += near_weak(grid, from);
  }
  return amplitude * amplitude * sum;
}

double BladeSpectrum::near_strong(TileGrid const& grid, int multiple) const {
  constexpr int around = 2;
  glm::dvec2 const at = static_cast<double>(multiple) * first_;
  auto const column = nearest_whole(at.x / grid.width);
  double sum = 0.0;
  for (std::int64_t x = column - around; x <= column + around; ++x) {
    auto const row = nearest_whole(at.y / grid.rows - static_cast<double>(x) * grid.shear);
    for (std::int64_t y = row - around; y <= row + around; ++y) {
      if (x == 0 && y == 0) continue;
      glm::dvec2 const vector = grid.reciprocal(static_cast<double>(x), static_cast<double>(y));
      double const error = outline_.amplitude(at - vector) / multiple;
      sum += error * error;
    }
  }
  return sum;
}

// Written for the compiler to take several at a time.
double BladeSpectrum::near_weak(TileGrid const& grid, int from) const {
  // Added and taken away, it leaves the nearest whole number.
  constexpr double rounding = 0x1.8p52;
  glm::dvec2 const cell(1.0 / grid.width, 1.0 / grid.rows);
  std::array<double, at_once> squared{};
  for (int i = 0; i < at_once; ++i) {
    auto const multiple = static_cast<double>(from + i);
    glm::dvec2 const at = multiple * first_;
    double const column = (at.x * cell.x + rounding) - rounding;
    double const row = (at.y * cell.y - column * grid.shear + rounding) - rounding;
    double const error = outline_.amplitude(at - grid.reciprocal(column, row)) / multiple;
    squared[static_cast<std::size_t>(i)] = column == 0.0 && row == 0.0 ? 0.0 : error * error;
  }
  return std::accumulate(squared.begin(), squared.end(), 0.0);
}

}  // namespace gpu_shading
