#pragma once

#include <array>
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

  // The ray's projection along itself onto two axes. The third is the one along which it is
  // longest; `shear` is how far it goes along the others meanwhile.
  std::array<std::size_t, 3> axes;
  std::array<double, 3> start;  // the origin along these axes
  std::array<double, 2> shear;
};

}  // namespace gpu_shading
