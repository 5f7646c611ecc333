#pragma once

#include <glm/vec3.hpp>

#include "gpu_shading/polygon.h"

namespace gpu_shading {

// The placement of a screen's tile on a surface. Axes before `rotation`: u from the outline's
// second vertex to its third, v counterclockwise from u as seen from outside. The tile's (0, 0) is
// at `origin` along these axes from the second vertex, and the tile is rotated about it by
// `rotation`, in radians, counterclockwise as seen from outside. On EnergyPlus's surfaces, the
// second vertex is the lower left corner and u the lower edge. Seen from inside, the tile is
// mirrored, because it is the same sheet.
struct ScreenPlacement {
  double origin_u = 0.0;  // m
  double origin_v = 0.0;
  double rotation = 0.0;
};

// A screen's placement on a polygon, in world axes (m). The polygon must have an area; if it is not
// quite planar, its plane is used.
struct TileAxes {
  glm::dvec3 origin;  // the tile's (0, 0)
  glm::dvec3 u;       // unit vectors
  glm::dvec3 v;
};
TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement);

}  // namespace gpu_shading
