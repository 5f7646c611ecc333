#pragma once

#include <functional>
#include <string>
#include <utility>

namespace gpu_shading::energyplus {

// The time that EnergyPlus is computing for.
struct Moment {
  int hour = 0;  // 1 .. 24
  // Of the hour, from 1; 0: the whole simulation, whose least transmittance and largest deployment
  // count.
  int timestep = 0;

  bool operator==(Moment const&) const = default;
};

// How a session reads schedules, by upper-case names; values within 0 .. 1. They throw Error where
// there is no such schedule, without the field that names it.
struct Schedules {
  std::function<std::pair<double, double>(std::string const& name)> range;  // of the simulation
  std::function<double(std::string const& name, Moment)> value;  // the least where all of it counts
};

}  // namespace gpu_shading::energyplus
