#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "geometry/plane_frame.h"
#include "view/view.h"

namespace gpu_shading {

// Upper limit of the Fourier transform of a receiver that fills its bounding rectangle. Frequencies
// are in cycles per tile.
class OutlineSpectrum {
 public:
  // On a tile that is not stretched, by the slope of its turn.
  explicit OutlineSpectrum(double slope) {
    double const c = 1.0 / std::sqrt(1.0 + slope * slope);
    double const s = slope * c;
    double const side = std::numbers::pi / (c + std::abs(s));
    u_ = side * glm::dvec2(c, s);
    v_ = side * glm::dvec2(-s, c);
  }
  OutlineSpectrum(TileMap const& map, PlaneFrame const& frame)
      : u_(0.5 * std::numbers::pi * frame.width * map.matrix[0]),
        v_(0.5 * std::numbers::pi * frame.height * map.matrix[1]) {}

  double amplitude(glm::dvec2 const& frequency) const {
    double const u = std::abs(glm::dot(u_, frequency));
    double const v = std::abs(glm::dot(v_, frequency));
    return 1.0 / (std::max(1.0, u) * std::max(1.0, v));
  }
  // Its inverse, by no branch and no division.
  double decay(glm::dvec2 const& frequency) const {
    double const u = std::abs(glm::dot(u_, frequency));
    double const v = std::abs(glm::dot(v_, frequency));
    return at_least_1(u) * at_least_1(v);
  }

 private:
  static double at_least_1(double value) { return 0.5 * (value + 1.0 + std::abs(value - 1.0)); }

  glm::dvec2 u_;  // sides of the rectangle, in tiles, times pi
  glm::dvec2 v_;
};

}  // namespace gpu_shading
