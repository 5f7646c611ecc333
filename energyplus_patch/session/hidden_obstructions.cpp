#include "session/hidden_obstructions.h"

#include <algorithm>

namespace gpu_shading::energyplus {

HiddenObstructions::HiddenObstructions(SceneAssembly const& scene) : scene_(scene) {
  auto const casters = scene.hidden_casters();
  if (casters.size() > 0) rays_.emplace(casters, RayOptions{.faces = RayFaces::both});
}

double HiddenObstructions::transmittance(Ray const& ray, int hour) {
  if (!rays_) return 1.0;
  auto const& shares = shares_of(hour);
  return rays_->transmittance(ray, {.factors = shares.factors, .deployments = shares.deployments});
}

HiddenObstructions::Shares const& HiddenObstructions::shares_of(int hour) {
  hour = std::clamp(hour, 1, hours);
  auto& shares = shares_[static_cast<std::size_t>(hour - 1)];
  if (!shares) {
    Moment const moment{hour, 1};
    auto const& optics = scene_.optics();
    shares = Shares{optics.factors_at(moment), optics.deployments_at(moment)};
  }
  return *shares;
}

}  // namespace gpu_shading::energyplus
