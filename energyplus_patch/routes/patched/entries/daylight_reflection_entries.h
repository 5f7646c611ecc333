#pragma once

#include <vector>

#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/memory/daylight_reflections.h"

namespace gpu_shading::energyplus {

// EnergyPlus's functions of reflections in daylighting, redirected to this_run()'s session if that
// answers for daylighting and for solar reflections and has hidden casters.
std::vector<EntryPatch> daylight_reflection_entries();

// EnergyPlus's function for the light of a window's element, which is called but not redirected;
// nullptr if the library lacks it.
ElementFunction* find_element_function(SymbolTable const& symbols);

// What answers in this run; nullptr if EnergyPlus alone does.
DaylightReflections* daylight_reflections(State& state);

// EnergyPlus begins its solar reflections anew.
void forget_daylight_reflections();

}  // namespace gpu_shading::energyplus
