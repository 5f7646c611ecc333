#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The functions of GLFW 3 by which EnergyPlus's pixel counting gets an OpenGL context, and the
// functions of OpenGL: those of opengl_function(). The library exports them all.
std::vector<EntryPatch> glfw_entries();

}  // namespace gpu_shading::energyplus
