#pragma once

#include "backends/interface/picture_raster.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/renderer.h"

namespace gpu_shading {

// A receiver in the sun's own view, a parallel projection along the rays, `size` pixels on the
// longer side; everything else of the scene is drawn around it. It has the colours of fractions by
// its luminance. `frame`: the receiver's.
Image draw_receiver(PictureRaster& raster, Scene const& scene, ShadedReceiver const& shaded,
                    PlaneFrame const& frame, int size);

}  // namespace gpu_shading
