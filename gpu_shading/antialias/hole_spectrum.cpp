#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "antialias/spectra.h"
#include "geometry/convex_area.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

}  // namespace

bool alike(Screens::Entry const& a, Screens::Entry const& b) {
  constexpr double near = 1e-9;
  return a.screen == b.screen && glm::length(a.u - b.u) < near && glm::length(a.v - b.v) < near;
}

HoleSpectrum::HoleSpectrum(Screens::Entry const& screen, SheetInBeam const& sheet, View const& view,
                           OutlineSpectrum const& outline)
    : outline_(outline), open_(screen.screen->open_fraction()) {
  glm::dvec3 const x(view.x);
  glm::dvec3 const y(view.y);
  glm::dmat2 const to_place =
      2.0 * glm::inverse(glm::dmat2(glm::dot(x, screen.u), glm::dot(y, screen.u),
                                    glm::dot(x, screen.v), glm::dot(y, screen.v)));
  glm::dvec2 const tile(sheet.tile);
  lowest_ = glm::dmat2(1.0 / tile.x, 0.0, 0.0, 1.0 / tile.y);
  bool const staggered = sheet.staggered && sheet.shape != SheetShape::image;
  if (staggered) lowest_ = lowest_ * glm::dmat2(1.0, 1.0, 1.0, -1.0);
  basis_ = glm::transpose(to_place) * lowest_;
  to_index_ = glm::inverse(basis_);
  per_area_ = std::abs(glm::determinant(lowest_));
  describe(*screen.screen, sheet);
}

void HoleSpectrum::change(glm::dmat2 const& change, OutlineSpectrum const& outline) {
  basis_ = change * basis_;
  to_index_ = glm::inverse(basis_);
  outline_ = outline;
}

double HoleSpectrum::squared_error(TileGrid const& grid, int row, double negligible) const {
  int const order = rows(grid) - 1;
  // Beyond this, on small grids, only a frequency that a vector nearly meets matters.
  int const low = is_large(grid) ? order : 12;
  constexpr double nearly = 2.0;
  constexpr std::size_t max_vectors = 2 * max_rows - 1;
  std::size_t const vectors = 2 * static_cast<std::size_t>(order) + 1;
  std::array<double, max_vectors> x;
  std::array<double, max_vectors> y;
  std::array<double, max_vectors> squared_distance;
  std::array<double, max_vectors> decay;
  glm::dvec2 const first = to_index_ * grid.reciprocal(-order, row);
  glm::dvec2 const step = to_index_ * grid.reciprocal(1.0, 0.0);
  // Written for the compiler to take several at a time.
  for (std::size_t i = 0; i < vectors; ++i) {
    auto const column = static_cast<double>(static_cast<int>(i));
    glm::dvec2 const index = first + column * step;
    glm::dvec2 const whole(nearest_whole(index.x), nearest_whole(index.y));
    glm::dvec2 const off = basis_ * (index - whole);
    x[i] = whole.x;
    y[i] = whole.y;
    squared_distance[i] = glm::dot(off, off);
    decay[i] = outline_.decay(off);
  }
  double const negligible_share = negligible / max_scale_;
  // Sides keep high frequencies from fading; a grid of more rows, for a smaller error, meets more.
  double const highest = grid.rows / size_;
  double sum = 0.0;
  for (std::size_t i = row == 0 ? static_cast<std::size_t>(order) + 1 : 0; i < vectors; ++i) {
    glm::dvec2 const frequency = lowest_ * glm::dvec2(x[i], y[i]);
    double const squared = glm::dot(frequency, frequency);
    if (squared > highest * highest || squared == 0.0) continue;
    if (negligible_share * negligible_share * squared * decay[i] * decay[i] >= 1.0) continue;
    bool const is_low = row <= low && std::abs(static_cast<int>(i) - order) <= low;
    if (!is_low && squared_distance[i] > nearly * nearly) continue;
    double const error = amplitude(frequency) / decay[i];
    sum += error * error;
  }
  return sum;
}

double HoleSpectrum::squared_error_across_sides(TileGrid const& grid, double negligible) const {
  if (!is_large(grid)) return 0.0;
  int const last = grid.rows / 3;
  double sum = 0.0;
  for (glm::dvec2 const& side : sides_) {
    glm::dvec2 across = glm::inverse(lowest_) * glm::dvec2(-side.y, side.x);
    bool const flat = std::abs(across.x) > std::abs(across.y);
    across /= flat ? across.x : across.y;
    glm::dvec2 const aside = flat ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0);
    for (int i = 1; i <= last; ++i) {
      glm::dvec2 const nearest(nearest_whole(i * across.x), nearest_whole(i * across.y));
      for (double const step : {-1.0, 0.0, 1.0}) {
        sum += squared_error_of(nearest + step * aside, grid, negligible);
      }
    }
  }
  return sum;
}

double HoleSpectrum::squared_error_of(glm::dvec2 const& index, TileGrid const& grid,
                                      double negligible) const {
  glm::dvec2 const at = basis_ * index;
  double const column = nearest_whole(at.x / grid.width);
  double const row = nearest_whole(at.y / grid.rows - column * grid.shear);
  if (std::max(std::abs(column), std::abs(row)) < rows(grid)) return 0.0;
  glm::dvec2 const frequency = lowest_ * index;
  double const decay = outline_.decay(at - grid.reciprocal(column, row));
  double const negligible_share = negligible * decay / max_scale_;
  if (negligible_share * negligible_share * glm::dot(frequency, frequency) >= 1.0) return 0.0;
  double const error = amplitude(frequency) / decay;
  return error * error;
}

void HoleSpectrum::describe(PerforatedScreen const& screen, SheetInBeam const& sheet) {
  double const half = sheet.half_hole;
  double size = 2.0 * half;
  switch (sheet.shape) {
    case SheetShape::square_holes:
      sides_ = {{2.0 * half, 0.0}, {0.0, 2.0 * half}};
      break;
    case SheetShape::hexagonal_holes: {
      double const side = 2.0 * half / std::numbers::sqrt3;
      sides_ = {{0.0, side},
                {std::numbers::sqrt3 / 2.0 * side, side / 2.0},
                {std::numbers::sqrt3 / 2.0 * side, -side / 2.0}};
      break;
    }
    case SheetShape::round_holes:
      arcs_ = std::sqrt(half) / pi;
      if (sheet.half_slot > 0.0F) sides_ = {{2.0 * static_cast<double>(sheet.half_slot), 0.0}};
      break;
    case SheetShape::image:
      size = screen.hole();
      arcs_ = std::sqrt(size / 2.0) / pi;
      per_area_ = open_ / (pi / 4.0 * size * size);
      break;
  }
  size_ = size;
  // No frequency is below one cycle of the longer side.
  max_scale_ = arcs_ * std::sqrt(static_cast<double>(std::max(sheet.tile.x, sheet.tile.y)));
  for (glm::dvec2 const& side : sides_) max_scale_ += glm::length(side) / pi;
  max_scale_ *= per_area_;
}

// Upper limit of the transform of all holes: of their straight sides, and of their arcs.
double HoleSpectrum::amplitude(glm::dvec2 const& frequency) const {
  double const squared = glm::dot(frequency, frequency);
  double sum = arcs_ / std::sqrt(squared * std::sqrt(squared));
  for (glm::dvec2 const& side : sides_) {
    double const along = pi * std::abs(glm::dot(side, frequency));
    sum += std::abs(cross(side, frequency)) / (pi * squared * std::max(1.0, along));
  }
  return std::min(open_, per_area_ * sum);
}

}  // namespace gpu_shading
