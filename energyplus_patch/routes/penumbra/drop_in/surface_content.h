#ifndef GPU_SHADING_PENUMBRA_SURFACE_CONTENT_H
#define GPU_SHADING_PENUMBRA_SURFACE_CONTENT_H

#include <gpu_shading_answers.h>
#include <penumbra/surface.h>

namespace Penumbra {

struct SurfaceContent {
  gpu_shading::answers::PlainSurface surface;
};

}  // namespace Penumbra

#endif
