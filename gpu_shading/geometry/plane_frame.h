#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// A receiver's own coordinates: u along its longest edge and v = normal x u, both unit vectors in
// its Newell plane. The origin is the centre of its bounding rectangle along u and v.
struct PlaneFrame {
  glm::dvec3 origin;
  glm::dvec3 u;
  glm::dvec3 v;
  glm::dvec3 normal;
  double width = 0.0;   // of the bounding rectangle along u, m
  double height = 0.0;  // along v
};

// Empty for a degenerate polygon.
std::optional<PlaneFrame> plane_frame(Polygon const& polygon);

}  // namespace gpu_shading
