#pragma once

#include <optional>
#include <vector>

#include "hidden/daylight_memory.h"
#include "routes/patched/binary/entry_patch.h"
#include "routes/patched/symbols/energyplus.h"

namespace gpu_shading::energyplus {

// The functions of daylighting that compute again what is known (DaylightMemory). They go with
// daylight_reflection_entries().
std::vector<EntryPatch> daylight_memory_entries();

// That of this thread's run; nullptr if EnergyPlus's daylighting is left alone.
DaylightMemory* daylight_memory();

// EnergyPlus begins to compute daylight factors.
void begin_daylight_memory(State& state);

// While EnergyPlus integrates over the sky that a window sees at an hour.
class SkyIntegral {
 public:
  SkyIntegral(int hour, int window);
  SkyIntegral(SkyIntegral const&) = delete;
  SkyIntegral& operator=(SkyIntegral const&) = delete;
  ~SkyIntegral();

 private:
  DaylightMemory* before_;
  std::optional<DaylightMemory::SkyOfWindow> sky_;
};

}  // namespace gpu_shading::energyplus
