#include "view/hole_spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "gpu_shading/perforated_screen.h"
#include "view/convex_area.h"
#include "view/nearest_whole.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;

}  // namespace

HoleSpectrum::HoleSpectrum(Screens::Entry const& screen, SheetInBeam const& sheet, View const& view,
                           OutlineSpectrum const& outline)
    : outline_(outline),
      staggered_(sheet.staggered && sheet.shape != SheetShape::image),
      open_(screen.screen->open_fraction()),
      tile_(sheet.tile) {
  glm::dvec3 const x(view.x);
  glm::dvec3 const y(view.y);
  glm::dmat2 const to_place =
      2.0 * glm::inverse(glm::dmat2(glm::dot(x, screen.u), glm::dot(y, screen.u),
                                    glm::dot(x, screen.v), glm::dot(y, screen.v)));
  basis_ = glm::transpose(to_place) * glm::dmat2(1.0 / tile_.x, 0.0, 0.0, 1.0 / tile_.y);
  to_index_ = glm::inverse(basis_);
  describe(*screen.screen, sheet);
}

double HoleSpectrum::error_at(glm::dvec2 const& vector, double within) const {
  glm::dvec2 const at = to_index_ * vector;
  glm::dvec2 const frequency = at / tile_;
  if (glm::dot(frequency, frequency) > highest_) return 0.0;
  std::int64_t column = nearest_whole(at.x);
  std::int64_t row = nearest_whole(at.y);
  if (staggered_ && ((column + row) & 1) != 0) {
    glm::dvec2 const rest(at.x - static_cast<double>(column), at.y - static_cast<double>(row));
    if (std::abs(rest.x) > std::abs(rest.y)) {
      column += rest.x > 0.0 ? 1 : -1;
    } else {
      row += rest.y > 0.0 ? 1 : -1;
    }
  }
  glm::dvec2 const nearest(static_cast<double>(column), static_cast<double>(row));
  if (nearest == glm::dvec2(0.0)) return 0.0;
  glm::dvec2 const off = basis_ * (at - nearest);
  if (glm::dot(off, off) > within * within) return 0.0;
  return amplitude(nearest / tile_) * outline_.amplitude(off);
}

std::vector<HoleSpectrum::Frequency> HoleSpectrum::lowest() const {
  constexpr int most = 3;
  constexpr double negligible = 0.02;
  std::vector<Frequency> found;
  for (int row = -most; row <= most; ++row) {
    for (int column = -most; column <= most; ++column) {
      bool const odd = staggered_ && (column + row) % 2 != 0;
      if (odd || (column == 0 && row == 0)) continue;
      glm::dvec2 const index(column, row);
      found.push_back({basis_ * index, amplitude(index / tile_)});
    }
  }
  auto const louder = [](Frequency const& a, Frequency const& b) {
    return a.amplitude < b.amplitude;
  };
  double const least = negligible * std::max_element(found.begin(), found.end(), louder)->amplitude;
  std::erase_if(found, [&](Frequency const& one) { return one.amplitude < least; });
  return found;
}

void HoleSpectrum::describe(PerforatedScreen const& screen, SheetInBeam const& sheet) {
  double const half = sheet.half_hole;
  double const area = tile_.x * tile_.y;
  per_area_ = (staggered_ ? 2.0 : 1.0) / area;
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
  constexpr double highest_in_holes = 60.0;
  highest_ = highest_in_holes * highest_in_holes / (size * size);
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
