#pragma once

#include <map>
#include <string>
#include <vector>

#include "platform/messages.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Takes the loss by partly shaded cells from the sunlit fractions of photovoltaic surfaces
// (--gpu-shading-pv), in run periods.
class PvLoss {
 public:
  explicit PvLoss(SceneAssembly const& scene);

  // The sunlit fraction, 0 .. 1, that EnergyPlus is to take in place of the rendered one.
  double reduced(SurfaceId surface, RunDay const& day, Moment moment, double rendered);

  // What was changed.
  void describe(Messages const& messages) const;

 private:
  struct Changed {
    std::string name;
    std::unordered_map<int, float> const* reductions = nullptr;
    std::size_t times = 0;
    double before = 0.0;  // sums of sunlit fractions
    double after = 0.0;
  };

  std::map<SurfaceId, Changed> surfaces_;
};

}  // namespace gpu_shading::energyplus
