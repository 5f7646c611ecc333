#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/polygon.h"

// Polygons in their plane, and points spread over them.
namespace gpu_shading::energyplus {

using FlatRing = std::vector<glm::dvec2>;

// EnergyPlus hands over vertices in single precision: a ray begins this far in front of its
// receiver, m, so that a surface in the same plane does not stop it.
inline constexpr double ray_lift = 1e-5;

// From one vertex of a ring to the next.
glm::dvec3 longest_edge(Ring const& ring);

// Whether an odd number of rings encloses a point.
bool is_inside(std::vector<FlatRing> const& rings, glm::dvec2 const& point);

// The i-th point, from 0, of the R2 sequence (Roberts 2018), which fills the unit square evenly.
glm::dvec2 spread_point(std::size_t i);

// Points of a polygon in its Newell plane, spread evenly: those of the R2 sequence that lie inside.
// `count` of them, or fewer for a polygon that fills little of its bounding rectangle; none for a
// degenerate one.
std::vector<glm::dvec3> polygon_samples(Polygon const& polygon, std::size_t count);

}  // namespace gpu_shading::energyplus
