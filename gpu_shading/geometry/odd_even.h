#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace gpu_shading {

// Triangles whose corners lie on an integer grid.
struct GridMesh {
  std::vector<glm::ivec2> points;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise
};

// Coordinates are at most this far from 0: areas are then exact in 64 bits.
inline constexpr int grid_limit = 1 << 29;

// Triangles that cover once the area inside an odd number of rings (the odd-even rule, also for a
// ring that intersects itself); rings run either way. Triangles meet corner to corner, so that no
// crack opens when their corners are rounded. Corners are those of the rings, where edges cross,
// and where the vertical through one of these meets another edge, rounded to the grid.
GridMesh triangulate_odd_even(std::span<std::vector<glm::ivec2> const> rings);

}  // namespace gpu_shading
