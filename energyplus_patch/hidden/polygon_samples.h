#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/polygon.h"

namespace gpu_shading::energyplus {

// Points of a polygon in its Newell plane, spread evenly: those of the R2 sequence (Roberts 2018)
// that lie inside. `count` of them, or fewer for a polygon that fills little of its bounding
// rectangle; none for a degenerate one.
std::vector<glm::dvec3> polygon_samples(Polygon const& polygon, std::size_t count);

}  // namespace gpu_shading::energyplus
