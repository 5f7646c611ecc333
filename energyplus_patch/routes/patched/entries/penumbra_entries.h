#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The replaced class, through which EnergyPlus asks for sunlit areas.
std::vector<EntryPatch> penumbra_entries();

}  // namespace gpu_shading::energyplus
