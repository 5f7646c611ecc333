#include "pictures/colours.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gpu_shading {

Colour tilt_grey(Surface const& surface, glm::dvec3 const& towards_sun) {
  constexpr double dark = 95.0;
  constexpr double light = 215.0;
  return Colour(glm::mix(dark, light, std::abs(glm::dot(normal(surface.polygon), towards_sun))));
}

}  // namespace gpu_shading
