#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "programs/gpu_shading/model_run.h"
#include "runs/run_times.h"

// The days that a command is about.
namespace gpu_shading::energyplus {

struct DayOptions {
  std::string from;  // "MM-DD"; empty: 1 January
  std::string to;    // "MM-DD", the last day; empty: 31 December
};

// --from and --to.
void add_days(CLI::App& command, DayOptions& days);

// Days by number, 100 x month + day, in any year.
struct Period {
  int from;
  int to;  // may be less: then across the new year

  bool has(RunTime const& time) const;
};

// Throws Error for what is no day.
Period period_of(DayOptions const& days);

// "06-21"
std::string day_text(int number);
// "06-01 to 08-31"
std::string describe_days(Period const& period);

// Throws Error without a weather file.
std::filesystem::path const& weather_of(ModelRun const& run);

// The times of the period with the sun up, from a run of EnergyPlus with nothing but calendar,
// weather and schedules: a second or two for a year of any model. The run that shades cannot
// provide them: it ends at the first question about shading, before any weather, and would
// otherwise simulate the building for the whole year. The model is read here for the names of the
// schedules, which EnergyPlus only reports if it is asked for them by name. Throws Error if there
// are no such times, or without a weather file.
RunTimes times_of(ModelRun const& run, Period const& period);

}  // namespace gpu_shading::energyplus
