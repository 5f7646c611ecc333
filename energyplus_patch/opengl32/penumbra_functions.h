#pragma once

namespace gpu_shading::energyplus {

// The function that GLFW or Penumbra calls by this name, as far as it does anything here; null for
// others.
void* penumbra_function(char const* name);

// The same for the library's users: null for functions of WGL's that it does not have, and one that
// does nothing for all others.
void* find_function(char const* name);

}  // namespace gpu_shading::energyplus
