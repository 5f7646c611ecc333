#include "sun/sampling/shadow_fall.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sun/sampling/sunlit_table.h"

namespace gpu_shading {

glm::dvec2 shadow_fall(glm::dvec3 const& normal, glm::dvec3 const& towards_sun) {
  // A horizontal plane has any number of horizontal lines: use the one to the east.
  constexpr double level = 1e-3;
  glm::dvec3 const along = std::hypot(normal.x, normal.y) > level
                               ? glm::normalize(glm::dvec3(-normal.y, normal.x, 0.0))
                               : glm::dvec3(1.0, 0.0, 0.0);
  double const cosine = std::max(glm::dot(normal, towards_sun), least_cosine);
  return {std::asinh(glm::dot(along, towards_sun) / cosine),
          std::asinh(glm::dot(glm::cross(normal, along), towards_sun) / cosine)};
}

}  // namespace gpu_shading
