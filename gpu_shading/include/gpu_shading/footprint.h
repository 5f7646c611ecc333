#pragma once

#include <vector>

#include "gpu_shading/local_axes.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// Corners in order, in either direction; the first may be repeated at the end. Elevations are
// ignored.
using GeographicRing = std::vector<GeographicPoint>;

// A building from map data: an upright prism on its outline, with open courtyards.
struct Footprint {
  GeographicRing outline;
  std::vector<GeographicRing> holes;
  double base = 0.0;  // elevations in m; the base may be above the ground
  double top = 0.0;
};

// Returns the building's roof, horizontal and with the courtyards as holes, and its walls, as
// polygons in the axes. Walls are vertical at the building's position. There is no floor, because
// rays from below meet a wall or the roof. Edges are straight, and corners within 1 mm of one
// another are merged. Across the antimeridian, a ring takes the short way, whatever turn its
// longitudes are given in.
//
// Throws Error if there are fewer than three corners, if a ring crosses itself, if a hole is not
// inside, or if the top is not above the base.
std::vector<Polygon> upright_prism(Footprint const& footprint, LocalAxes const& axes);

// Whether a point is inside a roof in plan, courtyards excluded; heights are ignored.
bool covers(Polygon const& roof, glm::dvec3 const& point);

}  // namespace gpu_shading
