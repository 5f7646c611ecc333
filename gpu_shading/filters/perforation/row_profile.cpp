#include "filters/perforation/row_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>
#include <numeric>

namespace gpu_shading {
namespace {

using std::numbers::sqrt3;

// Half the width of a hole at a height above its middle; less than 0 where there is none.
double half_width(SheetInBeam const& sheet, double height) {
  double const up = std::abs(height);
  double const half = sheet.half_hole;
  switch (sheet.shape) {
    case SheetShape::square_holes:
      return up <= half ? half : -1.0;
    case SheetShape::hexagonal_holes:
      return std::min(half, 2.0 * half - sqrt3 * up);
    case SheetShape::round_holes:
    case SheetShape::image:
      break;
  }
  return up <= half ? static_cast<double>(sheet.half_slot) + std::sqrt(half * half - up * up)
                    : -1.0;
}

// Half the height at a distance beside its middle.
double half_height(SheetInBeam const& sheet, double aside) {
  double const across = std::abs(aside);
  double const half = sheet.half_hole;
  switch (sheet.shape) {
    case SheetShape::square_holes:
      return across <= half ? half : -1.0;
    case SheetShape::hexagonal_holes:
      return across <= half ? (2.0 * half - across) / sqrt3 : -1.0;
    case SheetShape::round_holes:
    case SheetShape::image:
      break;
  }
  double const beyond = std::max(0.0, across - static_cast<double>(sheet.half_slot));
  return beyond <= half ? std::sqrt(half * half - beyond * beyond) : -1.0;
}

// The length in which a line is in a hole at both faces: what is within `a` of 0 and, moved by
// `shift`, within `b`.
double common(double a, double b, double shift) {
  if (a < 0.0 || b < 0.0) return 0.0;
  return std::max(0.0, std::min(a, b - shift) - std::max(-a, -b - shift));
}

}  // namespace

RowProfile::RowProfile(SheetInBeam const& sheet) : tile_(sheet.tile), mean_(sheet.effective[3]) {
  glm::dvec2 const ray_offset(sheet.ray_offset);
  auto const fill = [&](Profile& profile, double period, double across, auto open_at) {
    int const holes = sheet.staggered ? 2 : 1;
    for (std::size_t i = 0; i < steps; ++i) {
      double open = 0.0;
      for (int hole = 0; hole < holes; ++hole) {
        double const place = (static_cast<double>(i) + 0.5) / steps - 0.5 * hole;
        open += open_at((place - std::round(place)) * period);
      }
      profile[i] = static_cast<float>(open / across);
    }
    float const mean = std::accumulate(profile.begin(), profile.end(), 0.0F) / float{steps};
    for (float& value : profile) value -= mean;
  };
  fill(columns_, tile_.x, tile_.y, [&](double u) {
    return common(half_height(sheet, u), half_height(sheet, u + ray_offset.x), ray_offset.y);
  });
  fill(rows_, tile_.y, tile_.x, [&](double v) {
    return common(half_width(sheet, v), half_width(sheet, v + ray_offset.y), ray_offset.x);
  });
}

float RowProfile::at(glm::dvec2 const& place) const {
  glm::dvec2 const in_steps = glm::fract(place / tile_) * double{steps};
  return mean_ + columns_[static_cast<unsigned>(in_steps.x) % steps] +
         rows_[static_cast<unsigned>(in_steps.y) % steps];
}

void RowProfile::find(glm::dvec2 const& first, glm::dvec2 const& step, Passed& passed) const {
  // Steps of whole tiles make no difference; whole tiles keep what is converted above 0.
  constexpr double tiles = 0.5 * PatternRays::most;
  glm::dvec2 const change = step / tile_;
  glm::vec2 const start((glm::fract(first / tile_) + tiles) * double{steps});
  glm::vec2 const on((change - glm::round(change)) * double{steps});
  for (std::size_t i = 0; i < passed.size(); ++i) {
    auto const number = static_cast<float>(static_cast<int>(i));
    auto const column = static_cast<unsigned>(static_cast<int>(start.x + number * on.x)) % steps;
    auto const row = static_cast<unsigned>(static_cast<int>(start.y + number * on.y)) % steps;
    passed[i] = mean_ + columns_[column] + rows_[row];
  }
}

}  // namespace gpu_shading
