#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

struct Mesh {
  std::vector<glm::dvec3> vertices;
  std::vector<std::uint32_t> indices;  // three per triangle
};

// Triangles that cover the polygon minus its holes exactly once, by the odd-even rule, so that
// holes may run either way. Their vertices are those of the polygon and, unless it is convex, some
// on its edges, within 4e-9 of its size. Empty for a degenerate polygon.
Mesh triangulate(Polygon const& polygon);

// The triangles of every surface, in the scene's order. Throws Error if the total number of
// vertices does not fit in 32 bits.
std::vector<Mesh> triangulate_all(Scene const& scene);

// The mesh as convex pieces of up to four corners, in order; the last corner is repeated if there
// are three. Triangles that share an edge and lie in one plane are joined in pairs.
std::vector<glm::uvec4> convex_pieces(Mesh const& mesh);

}  // namespace gpu_shading
