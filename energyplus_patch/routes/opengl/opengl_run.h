#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/options/command_line.h"
#include "model/options/options.h"
#include "routes/opengl/hosted_model.h"

namespace gpu_shading::energyplus {

// A whole run of an unmodified EnergyPlus library, through its C API, with PixelCounting. Its calls
// of OpenGL must have been led to opengl_function(). `program`: runs the unmodified EnergyPlus.
// `read`: the model that `line`, read from `arguments`, names. Returns EnergyPlus's exit status.
// Throws Error.
int run_by_opengl(std::filesystem::path const& library, std::filesystem::path const& program,
                  CommandLine const& line, std::vector<std::string> arguments, HostedText read);

}  // namespace gpu_shading::energyplus
