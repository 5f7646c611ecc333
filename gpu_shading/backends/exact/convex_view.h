#pragma once

#include <optional>
#include <span>

#include "backends/exact/exact_view.h"
#include "backends/exact/projection.h"

namespace gpu_shading {

// As exact_sums() for few casters: the inclusion and exclusion of intersections of convex polygons.
// Holes are polygons of negative area. Empty where it cannot answer: outlines or holes that are not
// convex, holes that reach out of their outlines or overlap, many casters in one place, and
// interior surfaces in front of one another.
std::optional<ExactAnswer> convex_sums(Scene const& scene, Transmission const& transmission,
                                       ExactQuestion const& question, Projection const& projection);

}  // namespace gpu_shading
