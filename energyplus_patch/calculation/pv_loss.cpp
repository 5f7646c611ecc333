#include "calculation/pv_loss.h"

#include <fmt/format.h>

#include <algorithm>

namespace gpu_shading::energyplus {

PvLoss::PvLoss(SceneAssembly const& scene) {
  auto const& all = scene.model().pv_reductions.by_surface;
  for (SurfaceId id = 0; id < scene.surfaces().size(); ++id) {
    auto const& name = scene.surfaces()[id].name;
    auto const found = all.find(name);
    if (found != all.end()) surfaces_[id] = {name, &found->second};
  }
}

double PvLoss::reduced(SurfaceId surface, RunDay const& day, Moment moment, double rendered) {
  if (day.kind != RunDay::Kind::run_period) return rendered;
  auto const found = surfaces_.find(surface);
  if (found == surfaces_.end()) return rendered;
  auto& changed = found->second;
  PvReductions::Time const time{day.month, day.day, moment.hour, moment.timestep};
  auto const reduction = changed.reductions->find(time.key());
  if (reduction == changed.reductions->end() || reduction->second <= 0.0F) return rendered;
  double const after = std::max(rendered - static_cast<double>(reduction->second), 0.0);
  if (!day.warm_up) {
    ++changed.times;
    changed.before += rendered;
    changed.after += after;
  }
  return after;
}

void PvLoss::describe(Messages const& messages) const {
  for (auto const& [id, changed] : surfaces_) {
    if (changed.times == 0) {
      messages.warning(fmt::format("--gpu-shading-pv: no timestep of the run is among those of {}",
                                   changed.name));
      continue;
    }
    auto const times = static_cast<double>(changed.times);
    messages.remark(
        fmt::format("--gpu-shading-pv: {}: sunlit fraction reduced at {} timesteps, in "
                    "their mean from {:.3f} to {:.3f}",
                    changed.name, changed.times, changed.before / times, changed.after / times));
  }
}

}  // namespace gpu_shading::energyplus
