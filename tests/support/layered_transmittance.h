#pragma once

#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// The fraction of the beam that passes `layers` equidistant copies of the tile over the thickness,
// from four rays per texel. This is what a renderer of layers draws at twice the tile's resolution.
// 0 without layers. Shifts in m and phi in radians, as in screen_transmittance.h.
double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi);

}  // namespace gpu_shading
