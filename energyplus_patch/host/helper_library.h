#pragma once

namespace gpu_shading::energyplus {

// A function of one of our libraries that wrap another one, such as libgpu_shading_images.so. It
// lies beside this module or program and is loaded, with all that it needs, at the first call; its
// symbols stay its own. `what` needs it, as in "pictures". Throws Error.
void* helper_function(char const* library, char const* what, char const* name);

}  // namespace gpu_shading::energyplus
