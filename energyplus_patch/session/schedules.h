#pragma once

#include <functional>
#include <string>
#include <utility>

namespace gpu_shading::energyplus {

// The time that EnergyPlus is computing for.
struct Moment {
  int hour = 0;  // 1 .. 24
  int timestep =
      0;  // of the hour, from 1; 0: the whole simulation, whose least transmittance counts

  bool operator==(Moment const&) const = default;
};

// How a session reads transmittance schedules, by upper-case names; values within 0 .. 1.
struct Schedules {
  std::function<std::pair<double, double>(std::string const& name)> range;  // of the simulation
  std::function<double(std::string const& name, Moment)> value;
};

}  // namespace gpu_shading::energyplus
