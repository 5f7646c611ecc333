#pragma once

namespace gpu_shading::energyplus {

// A function of Windows's own opengl32.dll; null if it has none of that name.
void* system_function(char const* name);

}  // namespace gpu_shading::energyplus
