#pragma once

#include <vector>

#include "calculation/step_error.h"
#include "runs/run_times.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// What the shades of a scene do to the beam at a time.
struct ShadeConditions {
  std::vector<double> factors;      // by BeamFilter::schedule
  std::vector<double> deployments;  // by PerforatedSheet::deployment and Crown::deployment
  // Where moving shades stand, or what to interpolate between; the first is the nearest. One of no
  // positions if there are none.
  std::vector<WeightedPositions> positions;
};

// For each of a run's times, in order, as the schedules and controls of the model say; shades that
// --gpu-shading-positions names stand there. From now on, the scene reads the schedules of the run,
// which must outlive it. Throws Error, naming object and field, if the run lacks one.
std::vector<ShadeConditions> read_conditions(RunTimes const& run, SceneAssembly& scene);

}  // namespace gpu_shading::energyplus
