#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
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

// Of every surface, in the scene's order. Throws Error when there are more vertices in all than 32
// bits number.
std::vector<Mesh> triangulate_all(Scene const& scene);

// The mesh as convex pieces of up to four corners, in order; the last is repeated where there are
// three. Triangles that share an edge and lie in one plane are joined in pairs.
std::vector<glm::uvec4> convex_pieces(Mesh const& mesh);

}  // namespace gpu_shading
