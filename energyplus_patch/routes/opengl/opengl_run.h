#pragma once

#include <filesystem>

#include "routes/run_setup.h"

namespace gpu_shading::energyplus {

// A whole run of an unmodified EnergyPlus library, through its C API, with PixelCounting. Its calls
// of OpenGL must have been led to opengl_function(). `program`: runs the unmodified EnergyPlus. The
// model is read first, with `setup`.choices; EnergyPlus reads it without extension objects and
// surfaces that only cast shadows. Returns EnergyPlus's exit status. Throws Error.
int run_by_opengl(std::filesystem::path const& library, std::filesystem::path const& program,
                  RunSetup const& setup);

}  // namespace gpu_shading::energyplus
