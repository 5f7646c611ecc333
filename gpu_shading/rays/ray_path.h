#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>

#include "gpu_shading/rays.h"

namespace gpu_shading {

// A ray, prepared to be tested against boxes and polygons.
struct RayPath {
  // Throws Error if the ray has no direction or a number that is not finite.
  explicit RayPath(Ray const& ray);

  glm::dvec3 origin;
  glm::dvec3 direction;  // of unit length
  double length;

  // 1 / direction, finite.
  glm::dvec3 inverse;
  // The ray's projection along itself onto two axes. The third is the one along which it is
  // longest; `shear` is how far it goes along the others meanwhile.
  std::array<std::size_t, 3> axes;
  std::array<double, 3> start;  // the origin along these axes
  std::array<double, 2> shear;

  // Whether the part of the ray up to `limit` meets a box.
  bool meets(glm::dvec3 const& centre, glm::dvec3 const& reach, double limit) const {
    double enters = 0.0;
    double leaves = limit;
    for (int i = 0; i < 3; ++i) {
      double const middle = (centre[i] - origin[i]) * inverse[i];
      double const half = std::abs(reach[i] * inverse[i]);
      enters = std::max(enters, middle - half);
      leaves = std::min(leaves, middle + half);
    }
    return enters <= leaves;
  }
};

}  // namespace gpu_shading
