#pragma once

#include <cstdint>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

struct Mesh {
  std::vector<glm::dvec3> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle
};

// Triangles that cover the polygon less its holes once (odd winding, so holes run either way).
// Their vertices are the polygon's, but where its rings cross. Empty for a degenerate polygon.
Mesh triangulate(Polygon const& polygon);

}  // namespace gpu_shading
