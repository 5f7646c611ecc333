#pragma once

#include <vector>

#include "gpu_shading/local_axes.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// Corners in turn, either way round, the first repeated at the end or not. Elevations do not count.
using GeographicRing = std::vector<GeographicPoint>;

// A building as maps have it: what stands upright on its outline, courtyards left open.
struct Footprint {
  GeographicRing outline;
  std::vector<GeographicRing> holes;
  double base = 0.0;  // elevations, m; the base may be in the air
  double top = 0.0;
};

// Its roof, level and with the courtyards as holes, and its walls, as polygons in the axes. Walls
// are upright where the building stands. It has no floor: what comes in from below meets a wall or
// the roof. Edges are straight; corners within 1 mm of one another are one. Across the antimeridian
// a ring goes the short way, whichever turn its longitudes are given in.
//
// Throws Error: fewer than three corners, a ring that crosses itself, a hole that is not inside, a
// top that is not above the base.
std::vector<Polygon> upright_prism(Footprint const& footprint, LocalAxes const& axes);

// Whether a point lies in a roof's plan, courtyards excepted; heights do not count.
bool covers(Polygon const& roof, glm::dvec3 const& point);

}  // namespace gpu_shading
