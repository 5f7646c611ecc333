#pragma once

#include <vector>

#include "binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The functions with which EnergyPlus computes solar reflections. The originals answer for the
// surfaces that EnergyPlus knows, ours for the others.
std::vector<EntryPatch> reflection_entries();

}  // namespace gpu_shading::energyplus
