#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "gpu_shading/polygon.h"
#include "reports/page/run_page.h"

namespace gpu_shading::energyplus {

// The heights of some ground, facing up and flat or nearly so in each polygon, at the nodes of a
// grid over a rectangle in plan.
PageTerrain terrain_in(std::span<Polygon const* const> ground, glm::dvec2 const& low,
                       glm::dvec2 const& high);

}  // namespace gpu_shading::energyplus
