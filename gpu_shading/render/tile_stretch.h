#pragma once

#include "backends/interface/view_backend.h"
#include "filters/transmission.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// The stretch of a receiver's tile at which the centres of its pixels alias least
// with the holes of perforated screens and with blades at equal distances in a view; 1 where
// nothing repeats. The view's tile is the one that is not stretched.
double stretch_without_aliasing(ReceiverView const& view, Scene const& scene,
                                Transmission const& transmission);

}  // namespace gpu_shading
