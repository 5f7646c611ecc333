#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The watched functions: where EnergyPlus reads its input, which is changed in memory on the way;
// where it describes its shading in the .eio file; and where it ends.
std::vector<EntryPatch> input_entries();

}  // namespace gpu_shading::energyplus
