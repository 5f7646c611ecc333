#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "scheduled/run_times.h"

namespace gpu_shading::energyplus {

// Sunlit fractions of surfaces, 0 .. 1, at the times of a run with the sun up.
struct SunlitTable {
  std::vector<std::string> surfaces;
  int steps_per_hour = 0;
  std::vector<RunTime> times;                 // in the order of the year
  std::vector<std::vector<float>> fractions;  // by time, then surface

  bool empty() const { return times.empty(); }
};

// The file of EnergyPlus's Schedule:File objects: names of the surfaces on top, then a row for
// every timestep of a leap year, by which EnergyPlus counts; 0 where the table has none.
void write_schedule_file(SunlitTable const& table, std::ostream& out);

// The file form of Shading Calculation Method "Imported" (Schedule:File:Shading), as EnergyPlus
// itself writes it with Output External Shading Calculation Results: a time in front of every row.
// Of a leap year only where the table has 29 February.
void write_imported_file(SunlitTable const& table, std::ostream& out);

}  // namespace gpu_shading::energyplus
