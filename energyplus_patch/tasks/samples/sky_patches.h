#pragma once

#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// A part of the sky between two altitudes and two azimuths, or the cap around the zenith.
struct SkyPatch {
  SunDirection centre;       // middle of its altitudes and azimuths
  double solid_angle = 0.0;  // sr; those of a sky add up to 2 pi
};

struct SkyDivision {
  std::string name;
  std::vector<SkyPatch> patches;  // rows from the horizon, each from its first patch clockwise
};

// EnergyPlus's grid (scene/sky_grid.h), the first of each row in the east, counterclockwise.
SkyDivision energyplus_sky();

// Reinhart's division of Tregenza's sky (Tregenza 1987; Reinhart and Walkenhorst 2001), in the
// order and with the rows of Radiance's gendaymtx -m: 144 x factor^2 + 1 patches, the first of each
// row in the north, clockwise; the last is the zenith. Factor 1: Tregenza's 145 patches.
SkyDivision reinhart_sky(int factor);

}  // namespace gpu_shading::energyplus
