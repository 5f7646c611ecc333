#pragma once

#include <functional>
#include <string>
#include <vector>

#include "input/model_reader.h"
#include "scheduled/run_times.h"
#include "scheduled/sunlit_table.h"
#include "session/session.h"

namespace gpu_shading::energyplus {

// Renders what the sun lights of every exterior surface at every timestep that it is up, schedules
// of the run's values in it; where the model's options sample the sun's positions, from samples.
// `surfaces`: of the whole model. `latitude`: of the site, radians; asked for where it is sampled.
// Throws Error.
SunlitTable render_fractions(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
                             Session::Messages const& messages,
                             std::function<double()> const& latitude);

// The transmittance and deployment schedules of a model's shades, upper case, each once.
std::vector<std::string> shade_schedules(Model const& model);

// Those of them whose values only the run itself will know; and a warning of these.
std::vector<std::string> unknown_schedules(Model const& model, RunTimes const& run);
std::string describe_unknown(std::vector<std::string> const& schedules);

}  // namespace gpu_shading::energyplus
