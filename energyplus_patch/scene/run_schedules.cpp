#include "scene/run_schedules.h"

#include <algorithm>

#include "runs/schedule_value.h"

namespace gpu_shading::energyplus {

Schedules schedules_of(RunTimes const& run, std::shared_ptr<RunTime const*> const& now) {
  auto const range = [&run](std::string const& name) {
    double least = 1.0;
    double most = 0.0;
    for (auto const& time : run.times) {
      double const share = checked_share(name, schedule_value(run, time, name));
      least = std::min(least, share);
      most = std::max(most, share);
    }
    return std::pair(least, most);
  };
  auto const position = [&run, now](std::string const& name, Moment) {
    return schedule_value(run, **now, name);
  };
  auto const value = [position](std::string const& name, Moment moment) {
    return checked_share(name, position(name, moment));
  };
  return {range, value, position};
}

}  // namespace gpu_shading::energyplus
