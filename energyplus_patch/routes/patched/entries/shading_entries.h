#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"

namespace gpu_shading::energyplus {

// The watched functions of the shading calculation: those that give the hour and timestep, and the
// warning that transmittance schedules are ignored, which does not apply here.
std::vector<EntryPatch> shading_entries();

// The function that EnergyPlus calls as a day begins, for the report.
std::vector<EntryPatch> day_entries();

}  // namespace gpu_shading::energyplus
