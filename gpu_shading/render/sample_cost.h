#pragma once

#include <cstddef>

namespace gpu_shading {

struct Detail;

// Steps of an EdgeSweep that always take less time than samples.
inline constexpr double few_steps = 300.0;

// Time that the samples of a view take on one core, in steps of an EdgeSweep: an estimate within a
// factor of two (tests/bench/exact_cost). `side`: pixels per side of its tile.
double sample_cost(Detail const& detail, int side, bool transmits, std::size_t interiors);

}  // namespace gpu_shading
