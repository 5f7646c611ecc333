#pragma once

#include <filesystem>
#include <optional>

#include "options/options.h"

namespace gpu_shading::energyplus {

// Reads a model and its extensions and prints what each surface will be to the shading calculation,
// and every error. The surfaces come from EnergyPlus itself, run as far as it hands them over.
// `weather`: none takes one of EnergyPlus's own. `vertices`: prints their vertices, in world axes,
// instead. Throws Error.
void check(std::filesystem::path const& model, std::optional<std::filesystem::path> const& weather,
           Choices const& choices, bool vertices);

}  // namespace gpu_shading::energyplus
