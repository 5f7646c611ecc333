#pragma once

#include <functional>
#include <string>
#include <utility>

namespace gpu_shading::energyplus {

// The time for which EnergyPlus is computing.
struct Moment {
  int hour = 0;  // 1 .. 24
  // Timestep of the hour, from 1; 0: the whole simulation, for which the lowest transmittance and
  // the largest deployment apply.
  int timestep = 0;

  bool operator==(Moment const&) const = default;
};

// How a session reads schedules, by upper-case name; values are within 0 .. 1, except for
// positions. Functions throw Error if there is no such schedule, without naming the field.
struct Schedules {
  std::function<std::pair<double, double>(std::string const& name)> range;  // of the simulation
  // The lowest value for the whole simulation.
  std::function<double(std::string const& name, Moment)> value;
  // The value at a time, of any size; none: moving shades cannot be moved.
  std::function<double(std::string const& name, Moment)> position = {};
};

}  // namespace gpu_shading::energyplus
