#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The functions through which EnergyPlus asks what stands in the way of its rays of daylighting.
// The originals answer for the surfaces that EnergyPlus knows, ours for the others.
std::vector<EntryPatch> daylight_entries();

}  // namespace gpu_shading::energyplus
