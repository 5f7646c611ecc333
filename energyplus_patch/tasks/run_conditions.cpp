#include "tasks/run_conditions.h"

#include <memory>
#include <optional>
#include <utility>

#include "calculation/shade_control.h"
#include "scene/run_schedules.h"

namespace gpu_shading::energyplus {
namespace {

// The control of a model's moving shades, asked about the times of a run with the sun up.
class MovedShades {
 public:
  MovedShades(RunTimes const& run, SceneAssembly const& scene)
      : run_(run), shades_(scene.model().moving_shades), control_(scene) {}

  std::vector<WeightedPositions> at(RunTime const& time) {
    auto const row = row_of(time, run_.steps_per_hour);
    // Since the time before, the sun was down.
    if (row != next_row_) control_.decide(std::nullopt, {});
    next_row_ = row + 1;
    control_.set_time({time.hour, time.timestep});
    std::vector<double> positions;
    std::vector<double> exact;
    auto const& decisions =
        control_.decide(time.sun, {[&] { return time.beam; }, [&] { return time.wind; }});
    for (std::size_t i = 0; i < shades_.size(); ++i) {
      bool const stands = shades_[i].stands;
      positions.push_back(stands ? shades_[i].rest : decisions[i].position);
      exact.push_back(stands ? shades_[i].rest : decisions[i].exact);
    }
    return around(shades_, positions, exact);
  }

 private:
  RunTimes const& run_;
  std::vector<MovingShade> const& shades_;
  ShadeControl control_;
  std::size_t next_row_ = 0;
};

}  // namespace

std::vector<ShadeConditions> read_conditions(RunTimes const& run, SceneAssembly& scene) {
  auto const now = std::make_shared<RunTime const*>(nullptr);
  scene.set_schedules(schedules_of(run, now));
  auto& optics = scene.optics();
  std::optional<MovedShades> shades;
  if (!scene.model().moving_shades.empty()) shades.emplace(run, scene);
  std::vector<ShadeConditions> conditions;
  conditions.reserve(run.times.size());
  for (auto const& time : run.times) {
    *now = &time;
    optics.update({time.hour, time.timestep});
    conditions.push_back({optics.factors(), optics.deployments(),
                          shades ? shades->at(time) : std::vector<WeightedPositions>{{}}});
  }
  return conditions;
}

}  // namespace gpu_shading::energyplus
