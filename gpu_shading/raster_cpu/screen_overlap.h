#pragma once

#include "raster_cpu/screen_shading.h"
#include "view/view.h"

namespace gpu_shading {

// Whether some ray to a tile passes two of the screens. `view`: of the casters in front.
bool any_overlap(ScreensInView const& screens, View const& view);

}  // namespace gpu_shading
