#pragma once

#include <glm/vec3.hpp>

#include "gpu_shading/scene.h"

namespace gpu_shading::energyplus {

// Where a screen's tile lies on a polygon, in world coordinates: gpu_shading's ScreenPlacement,
// written out.
struct TileAxes {
  glm::dvec3 origin;  // the tile's (0, 0)
  glm::dvec3 u;       // unit vectors
  glm::dvec3 v;
};

// The polygon has to have an area.
TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement);

}  // namespace gpu_shading::energyplus
