#pragma once

#include <filesystem>

#include "model/options/options.h"
#include "runs/short_runs.h"

namespace gpu_shading::energyplus {

// Both functions run the EnergyPlus beside this program, and set call.program themselves. They
// throw Error.

// Writes the model with scheduled sunlit fractions, their file, and links to the files beside the
// original that it needs into a folder, for any program that runs EnergyPlus. Standard error lists
// what remains to EnergyPlus.
void export_scheduled(EnergyPlusCall call, Choices const& choices,
                      std::filesystem::path const& folder);

// Writes the file for Shading Calculation Method "Imported".
void export_imported(EnergyPlusCall call, Choices const& choices,
                     std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
