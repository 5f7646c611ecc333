#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "model/idf/new_object.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {

// Values for EnergyPlus's Schedule:File objects at the times of a run when the sun is up.
struct ScheduleTable {
  std::vector<std::string> columns;  // the surfaces that they are of
  double otherwise = 0.0;            // at all other times
  int steps_per_hour = 0;
  std::vector<RunTime> times;              // in the order of the year
  std::vector<std::vector<float>> values;  // by time, then column

  bool empty() const { return times.empty(); }
};

// Names of the columns in the first line, then a row for every timestep of a leap year, by which
// EnergyPlus counts.
void write_schedule_file(ScheduleTable const& table, std::ostream& out);

// The schedule of a column, from 0, of that file. `limits`: a ScheduleTypeLimits.
NewObject file_schedule(ScheduleTable const& table, std::size_t column, std::string const& name,
                        std::string const& limits, std::string const& file);

}  // namespace gpu_shading::energyplus
