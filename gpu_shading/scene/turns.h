#pragma once

#include <algorithm>
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

// Slopes of several turns, along the rows of at most one of which an edge lies.
inline constexpr std::size_t replicates_at_once = 3;
using ReplicateSlopes = std::array<double, replicates_at_once>;
inline constexpr ReplicateSlopes replicate_slopes{golden, -golden, 1.0 / golden};

// How much an edge is in step with the samples, by turn: 1 along a row or a column, less along
// samples that are further apart, (1, 1) to (2, 1), and 0 where it meets them evenly. `edge`: in
// lengths of the receiver's sides.
std::array<float, turns> const& in_step(glm::dvec2 const& edge);

// Length of the shadow edges that cross a receiver's bounding rectangle, including hidden ones, in
// lengths of the rectangle's side along which they run, so that an edge from end to end counts 1.
struct Detail {
  double along = 0.0;   // parallel to the rectangle's sides
  double across = 0.0;  // all others
  // The part that is in step with the samples of a tile, by its turn.
  std::array<double, turns> in_step{};

  double total() const { return along + across; }
  Detail& operator*=(double factor) {
    along *= factor;
    across *= factor;
    for (double& part : in_step) part *= factor;
    return *this;
  }
};

// The turn with the least detail in step with a tile's samples; the first, unless another is much
// better.
inline std::size_t best_turn(Detail const& detail) {
  constexpr double little = 0.1;
  constexpr double much = 2.0;
  auto const least = std::ranges::min_element(detail.in_step);
  double const first = detail.in_step.front();
  if (first < little || first < much * *least) return 0;
  return static_cast<std::size_t>(least - detail.in_step.begin());
}

}  // namespace gpu_shading
