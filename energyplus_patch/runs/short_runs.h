#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runs/drawing.h"
#include "runs/run_times.h"
#include "runs/schedule_days.h"

namespace gpu_shading::energyplus {

class ModelEditor;

// How to run EnergyPlus itself, and its arguments besides the model.
struct EnergyPlusCall {
  std::filesystem::path program;  // runs the unmodified EnergyPlus
  std::filesystem::path model;
  std::optional<std::filesystem::path> weather;
  bool expand = false;       // -x
  bool annual = false;       // -a
  bool design_days = false;  // -D: no run period
};

// EnergyPlus's own surfaces, from a run that ends after drawing them: a day without sizing and
// shading or, where EnergyPlus needs more, what the model asks for without shading. Throws Error
// with EnergyPlus's reasons if it does not get there.
std::vector<DrawnSurface> run_for_surfaces(EnergyPlusCall const& call);

// Whether EnergyPlus is to run one of the model's run periods, beside its design days.
bool runs_periods(EnergyPlusCall const& call, ModelEditor& model);

// Every timestep of the model's run periods and, with Dates::all, on dates without one of its
// design days, with EnergyPlus's own sun, weather and schedule values, from runs of the calendar
// and the schedules alone. Schedules that EnergyPlus does not know there (another program's, for
// example) are left out. Throws Error likewise.
enum class Dates { of_run_periods, all };
RunTimes run_for_times(EnergyPlusCall const& call, std::vector<std::string> const& schedules,
                       Dates dates);

// The same for a whole year, whatever the model's run periods and timestep; the year is that of its
// first run period.
RunTimes run_for_year(EnergyPlusCall const& call, std::vector<std::string> const& schedules,
                      int steps_per_hour);

// The same at the model's own timestep, with the weather.
RunTimes run_for_beam(EnergyPlusCall const& call, std::vector<std::string> const& schedules);

// The values of schedules on every day of the model's design days and run periods, or of the design
// days alone (-D). Throws Error likewise.
ScheduleDays run_for_schedules(EnergyPlusCall const& call,
                               std::vector<std::string> const& schedules);

// Writes a model into a folder under its own name, where relative file names work: see
// bring_named_files().
std::filesystem::path place_model(ModelEditor& model, std::filesystem::path const& original,
                                  std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
