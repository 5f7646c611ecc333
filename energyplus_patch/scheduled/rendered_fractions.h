#pragma once

#include <vector>

#include "input/model_reader.h"
#include "scheduled/run_times.h"
#include "scheduled/sunlit_table.h"
#include "session/session.h"

namespace gpu_shading::energyplus {

// Renders what the sun lights of every exterior surface at every timestep that it is up, schedules
// of the run's values in it. `surfaces`: of the whole model. Throws Error.
SunlitTable render_fractions(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
                             Session::Messages const& messages);

// The transmittance and deployment schedules of a model's shades, upper case, each once.
std::vector<std::string> shade_schedules(Model const& model);

// Those of them whose values only the run itself will know; and a warning of these.
std::vector<std::string> unknown_schedules(Model const& model, RunTimes const& run);
std::string describe_unknown(std::vector<std::string> const& schedules);

}  // namespace gpu_shading::energyplus
