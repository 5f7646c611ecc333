#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "calculation/session.h"
#include "model/model_reader.h"
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

// Renders the sunlit fractions of every exterior surface at every timestep with the sun up,
// including the run's schedule values; interpolated from samples if the model's options say so.
// `surfaces`: those of the whole model. `latitude`: the site's, in radians; only called when
// sampling. Throws Error.
SunlitFractions render_fractions(Model model, std::vector<Surface> const& surfaces,
                                 RunTimes const& run, Messages const& messages,
                                 std::function<double()> const& latitude);

// The file for EnergyPlus's Schedule:File objects: names of the surfaces in the first line, then a
// row for every timestep of a leap year, by which EnergyPlus counts; 0 at times that the table
// lacks.
void write_schedule_file(SunlitFractions const& table, std::ostream& out);

// The transmittance, deployment, leaf, position and availability schedules of a model's shades, in
// upper case, without duplicates.
std::vector<std::string> shade_schedules(Model const& model);

// A warning about those of them whose values are only known during the run, if any.
std::optional<std::string> warn_of_actuated(Model const& model);

}  // namespace gpu_shading::energyplus
