#pragma once

#include "routes/patched/memory/solar_reflections.h"

namespace gpu_shading::energyplus {

// What computes reflections in this run; nullptr if EnergyPlus alone does.
SolarReflections* solar_reflections(State& state);

}  // namespace gpu_shading::energyplus
