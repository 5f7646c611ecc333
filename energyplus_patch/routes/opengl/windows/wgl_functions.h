#pragma once

namespace gpu_shading::energyplus {

// The function that GLFW or Penumbra calls by this name: null for functions of WGL's that the
// library does not have.
void* find_function(char const* name);

}  // namespace gpu_shading::energyplus
