#pragma once

#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// As described at OpacityTile::web().
double longest_step(OpacityTile const& tile);

}  // namespace gpu_shading
