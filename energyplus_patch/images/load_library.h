#pragma once

namespace gpu_shading::energyplus {

// A function of libgpu_shading_images.so, which lies beside this module or program and is loaded,
// with OpenImageIO, at the first call (about 0.25 s). `what` needs it, as in "pictures". Throws
// Error.
void* image_function(char const* what, char const* name);

}  // namespace gpu_shading::energyplus
