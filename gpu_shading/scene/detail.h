#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "scene/turns.h"

namespace gpu_shading {

// Length of the shadow edges that cross a receiver's bounding rectangle, including hidden ones, in
// lengths of the rectangle's side along which they run, so that an edge from end to end counts 1.
struct Detail {
  double along = 0.0;   // parallel to the rectangle's sides
  double across = 0.0;  // all others
  // Of these, what is in step with the samples of a tile, by its turn.
  std::array<double, turns> in_step{};

  double total() const { return along + across; }
};

// The turn at which least is in step with a tile's samples; the first, unless that is much better.
inline std::size_t best_turn(Detail const& detail) {
  constexpr double little = 0.1;
  constexpr double much = 2.0;
  auto const least = std::min_element(detail.in_step.begin(), detail.in_step.end());
  double const first = detail.in_step.front();
  if (first < little || first < much * *least) return 0;
  return static_cast<std::size_t>(least - detail.in_step.begin());
}

}  // namespace gpu_shading
