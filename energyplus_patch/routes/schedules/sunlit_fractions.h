#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "runs/run_times.h"

namespace gpu_shading::energyplus {

// Sunlit fractions of surfaces, 0 .. 1, at the times of a run when the sun is up.
struct SunlitFractions {
  std::vector<std::string> surfaces;
  int steps_per_hour = 0;
  std::vector<RunTime> times;                 // in the order of the year
  std::vector<std::vector<float>> fractions;  // by time, then surface

  bool empty() const { return times.empty(); }
};

// The file for EnergyPlus's Schedule:File objects: names of the surfaces in the first line, then a
// row for every timestep of a leap year, by which EnergyPlus counts; 0 at times that the table
// lacks.
void write_schedule_file(SunlitFractions const& table, std::ostream& out);

}  // namespace gpu_shading::energyplus
