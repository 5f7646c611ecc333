#pragma once

namespace gpu_shading::energyplus {

// A function of one of our libraries that wrap another library, such as libgpu_shading_pictures.so.
// The library is beside this module or program. It is loaded with its dependencies at the first
// call, with its symbols kept local. `what` names the feature that needs it, as in "pictures".
// Throws Error.
void* plugin_function(char const* library, char const* what, char const* name);

}  // namespace gpu_shading::energyplus
