#pragma once

#include <optional>

#include "hidden/daylight_memory.h"
#include "routes/patched/symbols/energyplus_types.h"

namespace gpu_shading::energyplus {

// This thread's run's; nullptr if EnergyPlus's daylighting is left alone.
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
