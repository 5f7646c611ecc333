#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/memory/solar_reflections.h"

namespace gpu_shading::energyplus {

// The functions with which EnergyPlus computes solar reflections. The originals answer for the
// surfaces that EnergyPlus knows, ours for the others.
std::vector<EntryPatch> reflection_entries();

// What computes reflections in this run; nullptr if EnergyPlus alone does.
SolarReflections* solar_reflections(State& state);

}  // namespace gpu_shading::energyplus
