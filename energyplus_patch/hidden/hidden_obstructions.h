#pragma once

#include <optional>

#include "gpu_shading/rays.h"
#include "hidden/hour_shares.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// What stands in the way of EnergyPlus's rays of daylighting and is not in EnergyPlus's input:
// lean input and surroundings. Not for several threads at once.
class HiddenObstructions {
 public:
  // The scene must be complete() and outlive this. Throws Error if a screen's texture cannot be
  // read.
  explicit HiddenObstructions(SceneAssembly const& scene);

  // The product of what the obstructions along a ray let pass, 0 .. 1. `hour`: 1 .. 24, at whose
  // first timestep EnergyPlus reads the schedules of shading surfaces for daylighting.
  double transmittance(Ray const& ray, int hour);

  // Schedules may have other values from now on: another day.
  void renew() { shares_.renew(); }

 private:
  std::optional<RayScene> rays_;  // none: there is no obstruction
  HourShares shares_;
};

}  // namespace gpu_shading::energyplus
