#pragma once

#include <memory>

#include "runs/run_times.h"
#include "scene/schedules.h"

namespace gpu_shading::energyplus {

// A short run's schedules at the time that `now` points to, whatever the Moment; their range is
// that of the run's times. `run` must outlive the result.
Schedules schedules_of(RunTimes const& run, std::shared_ptr<RunTime const*> const& now);

}  // namespace gpu_shading::energyplus
