#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "gpu_shading/rays.h"
#include "scene/shade_optics.h"

namespace gpu_shading::energyplus {

// What schedules say at the hours of a day, 1 .. 24, at their first timestep, when EnergyPlus reads
// those of shading surfaces for rays. Read once each.
class HourShares {
 public:
  struct Shares {
    std::vector<double> factors;
    std::vector<double> deployments;

    bool operator==(Shares const&) const = default;
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

}  // namespace gpu_shading::energyplus
