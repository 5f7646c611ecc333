#pragma once

#include <istream>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// A day that EnergyPlus runs, of a design day or a run period.
struct ScheduleDay {
  int month = 0;
  int day = 0;
  std::string type;        // "Sunday", "SummerDesignDay", ...
  int days_left = 1;       // of its period, with itself
  double latitude = 0.0;   // of the site, degrees, north positive
  double longitude = 0.0;  // degrees, east positive
  double time_zone = 0.0;  // hours from universal time
  // By timestep of the day in standard time, and by schedule; as long as
  // 24 x steps_per_hour x schedules.
  std::vector<double> values;
};

// The values of schedules on all of these days.
struct ScheduleDays {
  int steps_per_hour = 0;
  std::vector<std::string> schedules;  // upper case
  std::vector<ScheduleDay> days;       // in the order in which they are run
};

// Reads an eplusout.eso with Schedule Value at every timestep. Throws Error.
ScheduleDays read_schedule_days(std::istream& eso);

}  // namespace gpu_shading::energyplus
