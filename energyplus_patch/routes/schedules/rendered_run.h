#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calculation/session.h"
#include "model/model_reader.h"
#include "routes/schedules/schedule_table.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {

class ModelEditor;

// What EnergyPlus is given before a run, by surface.
struct RenderedRun {
  ScheduleTable sunlit;   // fractions, 0 .. 1, of the exterior surfaces
  ScheduleTable grounds;  // reflectances of the own grounds of Model::reflected_light's receivers
};

enum class Rendered { all, grounds };

// Computes every timestep with the sun up, including the run's schedule values; fractions are
// interpolated from samples if the model's options say so. `surfaces`: those of the whole model.
// `latitude`: the site's, in radians; only called when sampling, or for grounds. Throws Error.
RenderedRun render_run(Model model, std::vector<Surface> const& surfaces, RunTimes const& run,
                       Messages const& messages, std::function<double()> const& latitude,
                       Rendered wanted = Rendered::all);

// Adds a schedule for each receiver of reflected light, by a file with `grounds` in the model's
// folder.
void add_ground_schedules(ModelEditor& editor, ReflectedLight const& light,
                          ScheduleTable const& grounds, std::filesystem::path const& folder);

// The transmittance, deployment, leaf, position and availability schedules of a model's shades, in
// upper case, without duplicates.
std::vector<std::string> shade_schedules(Model const& model);

// A warning about those of them whose values are only known during the run, if any.
std::optional<std::string> warn_of_actuated(Model const& model);

}  // namespace gpu_shading::energyplus
