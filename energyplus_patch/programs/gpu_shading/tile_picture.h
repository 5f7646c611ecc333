#pragma once

#include "gpu_shading/image.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading::energyplus {

// Draws one tile of a screen, `size` pixels on its longer side, seen from a point far to the right
// (where u points) at an angle in degrees from the normal: the face grey, the walls of holes dark,
// and what lies behind light. A pattern's tile has a hole at its centre.
Image draw_tile(PerforatedScreen const& screen, double angle, int size);

}  // namespace gpu_shading::energyplus
