#include "hidden/hidden_obstructions.h"

#include <algorithm>

namespace gpu_shading::energyplus {

HourShares::Shares const& HourShares::at(int hour) {
  int const nearest = std::clamp(hour, 1, static_cast<int>(hours));
  auto& shares = known_.at(static_cast<std::size_t>(nearest - 1));
  if (!shares) {
    Moment const moment{nearest, 1};
    shares = Shares{optics_.factors_at(moment), optics_.deployments_at(moment)};
  }
  return *shares;
}

HiddenObstructions::HiddenObstructions(SceneAssembly const& scene) : shares_(scene.optics()) {
  auto const casters = scene.hidden_casters();
  if (casters.size() > 0) rays_.emplace(casters, RayOptions{.faces = RayFaces::both});
}

double HiddenObstructions::transmittance(Ray const& ray, int hour) {
  return rays_ ? rays_->transmittance(ray, shares_.at(hour).conditions()) : 1.0;
}

}  // namespace gpu_shading::energyplus
