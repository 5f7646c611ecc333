#pragma once

#include <filesystem>

#include "options/options.h"
#include "scheduled/short_runs.h"

namespace gpu_shading::energyplus {

// Both run the EnergyPlus beside this program; call.program is theirs to say. They throw Error.

// The model with scheduled sunlit fractions, their file, and links to what lies beside the
// original, into a folder: for any program that runs EnergyPlus. What this leaves to EnergyPlus is
// said on standard error.
void export_scheduled(EnergyPlusCall call, Choices const& choices,
                      std::filesystem::path const& folder);

// The file form of Shading Calculation Method "Imported".
void export_imported(EnergyPlusCall call, Choices const& choices,
                     std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
