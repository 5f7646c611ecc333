#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>

namespace gpu_shading {

// How the rows of samples on a tile may be turned against its receiver's sides: slopes of the turn,
// which fractions approximate worst (they end in 1, 1, 1, ... as continued fractions), so that
// edges along the sides (nearly all edges in buildings) meet the samples evenly. The first is 1 /
// golden ratio; the others are for edges that are in step with it.
inline constexpr double golden = 0.61803398874989484820;
inline constexpr std::array turn_slopes{golden, -golden, golden* golden, -golden* golden};
inline constexpr std::size_t turns = turn_slopes.size();

// How much an edge is in step with the samples, by turn: 1 along a row or a column, less along
// samples that are further apart, (1, 1) to (2, 1), and 0 where it meets them evenly. `edge`: in
// lengths of the receiver's sides.
std::array<float, turns> const& in_step(glm::dvec2 const& edge);

}  // namespace gpu_shading
