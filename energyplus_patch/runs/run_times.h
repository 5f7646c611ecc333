#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <istream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading::energyplus {

// A zone timestep of a run period, in standard time.
struct RunTime {
  int month = 0;
  int day = 0;
  int hour = 0;      // 1 .. 24
  int timestep = 0;  // timestep of the hour, from 1
  SunDirection sun;  // as EnergyPlus uses it for the whole timestep
  std::vector<double> schedules;
  // From run_for_times() and run_for_beam():
  double beam = 0.0;                 // direct normal irradiance, W/m2
  double diffuse = 0.0;              // diffuse horizontal irradiance, W/m2
  double reflected_by_ground = 0.0;  // of level ground in the open, W/m2
  double temperature = 0.0;          // of the air, degC
  double wind = 0.0;                 // speed, m/s

  bool operator==(RunTime const&) const = default;
};

struct RunTimes {
  int steps_per_hour = 0;
  std::vector<RunTime> times;          // each time of a year once
  std::vector<std::string> schedules;  // upper case; their values are in `times`
  int year = 0;  // of the first row; of run_for_year() and run_for_beam() alone

  bool operator==(RunTimes const&) const = default;
};

// 0 .. 365: of a leap year, by which EnergyPlus indexes schedules.
int day_of_schedule(int month, int day);

// 0 .. 366 x 24 x steps - 1: the row of a schedule file of a leap year.
std::size_t row_of(RunTime const& time, int steps_per_hour);

// The value of a schedule (upper case) at one of the run's times. Throws Error if the run has no
// such schedule, or the value is not a finite number.
double schedule_value(RunTimes const& run, RunTime const& time, std::string const& name);

// EnergyPlus's own limit (Engineering Reference, "Shading Module"): below it, the sun is down; with
// a smaller cosine of incidence, it is behind a surface.
inline constexpr double min_cosine = 1e-5;
bool sun_is_up(SunDirection sun);

// The sunlit fraction as EnergyPlus reports it, 0 .. 1, from the projected sunlit area (m2).
// `area`: unit normal times net area (m2); `sun`: unit vector to the sun.
double sunlit_fraction(double projected_area, glm::dvec3 const& area, glm::dvec3 const& sun);

// EnergyPlus's output variables of the weather, and where their values are kept.
inline constexpr std::array<std::pair<std::string_view, double RunTime::*>, 5> weather_variables{
    {{"Site Direct Solar Radiation Rate per Area", &RunTime::beam},
     {"Site Diffuse Solar Radiation Rate per Area", &RunTime::diffuse},
     {"Site Ground Reflected Solar Radiation Rate per Area", &RunTime::reflected_by_ground},
     {"Site Outdoor Air Drybulb Temperature", &RunTime::temperature},
     {"Site Wind Speed", &RunTime::wind}}};

// Reads an eplusout.eso with Site Solar Azimuth Angle, Site Solar Altitude Angle, Schedule Value
// and, perhaps, weather_variables at every timestep. Throws Error if two periods have different sun
// positions or schedule values at the same time of the year, unless the first counts.
enum class Repeated { alike, first };
RunTimes read_run_times(std::istream& eso, Repeated repeated = Repeated::alike);

// The year in which the first run period of an eplusout.eio begins. Throws Error if it names none.
int read_first_year(std::istream& eio);

}  // namespace gpu_shading::energyplus
