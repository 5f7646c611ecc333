#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scheduled/drawing.h"
#include "scheduled/run_times.h"

namespace gpu_shading::energyplus {

class ModelEditor;

// How EnergyPlus itself is run, and what it is told of a model besides.
struct EnergyPlusCall {
  std::filesystem::path program;  // runs EnergyPlus as it is
  std::filesystem::path model;
  std::optional<std::filesystem::path> weather;
  bool expand = false;       // -x
  bool annual = false;       // -a
  bool design_days = false;  // -D: no run period
};

// EnergyPlus's own surfaces, from a run to where it draws them: a day at most, without sizing and
// without shadows. Throws Error with EnergyPlus's reasons where it does not get there.
std::vector<DrawnSurface> run_for_surfaces(EnergyPlusCall const& call);

// Every timestep of the model's run periods, with EnergyPlus's own sun and the values of schedules:
// a run of the calendar and the schedules alone. A schedule that EnergyPlus does not know there
// (another program's, say) is left out of the answer. Throws Error like it.
RunTimes run_for_times(EnergyPlusCall const& call, std::vector<std::string> const& schedules);

// The same of a whole year, whatever the model's run periods and timestep are: that of its first
// run period.
RunTimes run_for_year(EnergyPlusCall const& call, std::vector<std::string> const& schedules,
                      int steps_per_hour);

// Writes a model into a folder under its own name, with links to what lies beside the original, so
// that relative names of files hold.
std::filesystem::path place_model(ModelEditor& model, std::filesystem::path const& original,
                                  std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
