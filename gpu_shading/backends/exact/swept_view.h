#pragma once

#include <optional>
#include <span>

#include "backends/exact/exact_view.h"
#include "backends/exact/projection.h"

namespace gpu_shading {

// As exact_sums(), of any outlines and any number of casters: a sweep of all edges (EdgeSweep).
// Empty if it would take more than `most_steps`, behind very many combinations of schedules, or
// where interior surfaces pass through one another.
std::optional<ExactAnswer> swept_sums(Scene const& scene, Transmission const& transmission,
                                      ExactQuestion const& question, Projection const& projection,
                                      double most_steps);

}  // namespace gpu_shading
