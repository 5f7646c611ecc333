#pragma once

#include <vector>

#include "binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The watched functions of the shading calculation: which hour and timestep it is for, and the
// message that transmittance schedules are not applied, which is not so.
std::vector<Entry> shading_entries();

}  // namespace gpu_shading::energyplus
