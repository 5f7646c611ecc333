#include "hidden/hidden_obstructions.h"

namespace gpu_shading::energyplus {

HiddenObstructions::HiddenObstructions(SceneAssembly const& scene) : shares_(scene.optics()) {
  auto const casters = scene.hidden_casters();
  if (casters.size() > 0) rays_.emplace(casters, RayOptions{.faces = RayFaces::both});
}

double HiddenObstructions::transmittance(Ray const& ray, int hour) {
  return rays_ ? rays_->transmittance(ray, shares_.at(hour).conditions()) : 1.0;
}

}  // namespace gpu_shading::energyplus
