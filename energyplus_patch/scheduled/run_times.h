#pragma once

#include <glm/vec3.hpp>
#include <istream>
#include <string>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// A zone timestep of a run period, in standard time.
struct RunTime {
  int month = 0;
  int day = 0;
  int hour = 0;      // 1 .. 24
  int timestep = 0;  // of the hour, from 1
  SunDirection sun;  // where EnergyPlus has it for all of the timestep
  std::vector<double> schedules;
};

struct RunTimes {
  int steps_per_hour = 0;
  std::vector<RunTime> times;          // each time of a year once
  std::vector<std::string> schedules;  // upper case: whose values the times have
};

// Days of a leap year, which EnergyPlus counts schedules by.
inline constexpr int schedule_days = 366;

// 0 .. 365.
int day_of_schedule(int month, int day);

// 0 .. 366 x 24 x steps - 1: the row of a schedule file of a leap year.
std::size_t row_of(RunTime const& time, int steps_per_hour);

// The value of a schedule (upper case) at one of the run's times, held within 0 .. 1; 0 where
// EnergyPlus does not know it.
double schedule_value(RunTimes const& run, RunTime const& time, std::string const& name);

// EnergyPlus's own limit (Engineering Reference, "Shading Module"): the sun is down below it, and
// behind a surface of a smaller cosine of incidence.
bool sun_is_up(SunDirection sun);

// As EnergyPlus reports it, 0 .. 1, from the projected sunlit area (m2). `area`: unit normal times
// net area (m2); `sun`: unit vector to the sun.
double sunlit_fraction(double projected_area, glm::dvec3 const& area, glm::dvec3 const& sun);

// From an eplusout.eso with Site Solar Azimuth Angle, Site Solar Altitude Angle and Schedule Value
// at every timestep. Throws Error where two run periods have the sun elsewhere at the same time of
// the year.
RunTimes read_run_times(std::istream& eso);

}  // namespace gpu_shading::energyplus
