#pragma once

#include "routes/patched/memory/daylight_reflections.h"

namespace gpu_shading::energyplus {

// What answers in this run; nullptr if EnergyPlus alone does.
DaylightReflections* daylight_reflections(State& state);

// EnergyPlus begins its solar reflections anew.
void forget_daylight_reflections();

}  // namespace gpu_shading::energyplus
