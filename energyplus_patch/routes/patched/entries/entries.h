#pragma once

#include <vector>

#include "hidden/daylight_memory.h"
#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/symbols/energyplus_symbols.h"

namespace gpu_shading::energyplus {

// A function of the table of symbols that is redirected to ours.
struct Entry {
  Need need;
  EntryPatch patch;
};

// An entry whose original no longer runs.
template <typename Returned, typename... Arguments>
Entry replace(Function<Returned(Arguments...)> const& function, Returned (*ours)(Arguments...)) {
  return {function.need, replace(function.symbol, ours)};
}

// An entry whose original still runs, through `original`.
template <typename Returned, typename... Arguments>
Entry watch(Function<Returned(Arguments...)> const& function, Returned (*ours)(Arguments...),
            Returned (**original)(Arguments...)) {
  return {function.need, watch(function.symbol, ours, original)};
}

// The replaced class, through which EnergyPlus asks for sunlit areas.
std::vector<Entry> penumbra_entries();
// The watched functions: where EnergyPlus reads its input, which is changed in memory on the way;
// where it describes its shading in the .eio file; and where it ends.
std::vector<Entry> input_entries();
// Those of the shading calculation that give the day, hour and timestep, and those that warn of
// what does not apply here.
std::vector<Entry> shading_entries();
// Those through which EnergyPlus writes errors and warnings: UnwantedMessages.
std::vector<Entry> message_entries();
// Those that tell what obstructs rays of daylighting. The originals answer for the surfaces that
// EnergyPlus knows, ours for the others.
std::vector<Entry> daylight_entries();
// Those of daylighting that compute again what is known: DaylightMemory.
std::vector<Entry> daylight_memory_entries();

// That by which the light is set that this run's model reflects.
std::vector<Entry> reflected_light_entries();

// The functions of GLFW 3 by which EnergyPlus's pixel counting gets an OpenGL context, and the
// functions of OpenGL: those of opengl_function(). The library exports them all.
std::vector<EntryPatch> glfw_entries();

// Has EnergyPlus hand over the light that is not beam at the end of each timestep.
void record_light(State& state);

// The memory of this thread's run; nullptr if EnergyPlus's daylighting is left alone.
DaylightMemory* daylight_memory();

// EnergyPlus begins to compute daylight factors.
void begin_daylight_memory();

// EnergyPlus has set the sun, or asks for the next patch of the sky.
void note_sun();

}  // namespace gpu_shading::energyplus
