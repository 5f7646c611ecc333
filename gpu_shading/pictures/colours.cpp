#include "pictures/colours.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gpu_shading {

Colour tilt_grey(Surface const& surface, glm::dvec3 const& towards_sun) {
  constexpr double dark = 95.0;
  constexpr double light = 215.0;
  return Colour(glm::mix(dark, light, std::abs(glm::dot(normal(surface.polygon), towards_sun))));
}

glm::dvec3 fraction_colour(double fraction) {
  static std::array<glm::dvec3, 17> const steps{{{0.0, 34.0, 78.0},
                                                 {0.0, 46.0, 106.0},
                                                 {26.0, 56.0, 111.0},
                                                 {50.0, 67.0, 109.0},
                                                 {67.0, 78.0, 108.0},
                                                 {83.0, 90.0, 109.0},
                                                 {97.0, 101.0, 111.0},
                                                 {111.0, 112.0, 115.0},
                                                 {125.0, 124.0, 120.0},
                                                 {140.0, 136.0, 120.0},
                                                 {155.0, 148.0, 118.0},
                                                 {171.0, 160.0, 114.0},
                                                 {188.0, 174.0, 108.0},
                                                 {205.0, 187.0, 99.0},
                                                 {222.0, 201.0, 88.0},
                                                 {240.0, 216.0, 70.0},
                                                 {254.0, 232.0, 56.0}}};
  double const position = std::clamp(fraction, 0.0, 1.0) * (steps.size() - 1);
  auto const step = std::min(static_cast<std::size_t>(position), steps.size() - 2);
  return glm::mix(steps[step], steps[step + 1], position - static_cast<double>(step));
}

}  // namespace gpu_shading
