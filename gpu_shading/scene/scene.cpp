#include "gpu_shading/scene.h"

#include <utility>

namespace gpu_shading {

SurfaceId Scene::add(Surface surface) {
  surfaces_.push_back(std::move(surface));
  return static_cast<SurfaceId>(surfaces_.size() - 1);
}

bool Scene::may_shade(SurfaceId receiver, SurfaceId caster) const {
  return receiver != caster && surfaces_[caster].casting != Casting::never &&
         (!rule_ || rule_(receiver, caster));
}

}  // namespace gpu_shading
