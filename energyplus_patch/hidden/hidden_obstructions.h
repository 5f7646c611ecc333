#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "gpu_shading/rays.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Values of schedules at the hours of a day, 1 .. 24, at their first timestep, when EnergyPlus
// reads those of shading surfaces for rays. Read once each.
class HourShares {
 public:
  struct Shares {
    std::vector<double> factors;
    std::vector<double> deployments;

    RayConditions conditions() const { return {.factors = factors, .deployments = deployments}; }
  };

  // The optics must outlive this.
  explicit HourShares(ShadeOptics const& optics) : optics_(optics) {}

  // Hours out of range are taken as the nearest. Holds until renew().
  Shares const& at(int hour);

  // Schedules may have other values from now on: another day.
  void renew() { known_ = {}; }

 private:
  static constexpr std::size_t hours = 24;
  ShadeOptics const& optics_;
  std::array<std::optional<Shares>, hours> known_;
};

// Obstructions of EnergyPlus's rays of daylighting that are not in its input: lean input and
// surroundings. Not for several threads at once.
class HiddenObstructions {
 public:
  // The scene must be complete() and outlive this. Throws Error if a screen's texture cannot be
  // read.
  explicit HiddenObstructions(SceneAssembly const& scene);

  // Transmittance of all obstructions along a ray, 0 .. 1. `hour`: 1 .. 24, at whose
  // first timestep EnergyPlus reads the schedules of shading surfaces for daylighting.
  double transmittance(Ray const& ray, int hour);

  // Schedules may have other values from now on: another day.
  void renew() { shares_.renew(); }

 private:
  std::optional<RayScene> rays_;  // none: there is no obstruction
  HourShares shares_;
};

}  // namespace gpu_shading::energyplus
