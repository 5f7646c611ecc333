#include "gpu_shading/scene.h"

#include <fmt/format.h>

#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {

SurfaceId Scene::add(Surface surface) {
  if (!rule_.empty()) throw Error("a surface is added to a scene that has its shading rule");
  surfaces_.push_back(std::move(surface));
  return static_cast<SurfaceId>(surfaces_.size() - 1);
}

void Scene::set_rule(ShadingRule rule) {
  if (!rule.empty()) {
    if (rule.roles.size() != size()) {
      throw Error(fmt::format("a shading rule for {} surfaces: the scene has {}", rule.roles.size(),
                              size()));
    }
    if (rule.zone_shades.size() != rule.zones * rule.zones) {
      throw Error(fmt::format("a shading rule of {} zones: expected {} entries; got {}", rule.zones,
                              rule.zones * rule.zones, rule.zone_shades.size()));
    }
    for (auto const& role : rule.roles) {
      if (role.zone >= rule.zones) {
        throw Error(fmt::format("zone {} in a shading rule of {} zones", role.zone, rule.zones));
      }
    }
  }
  rule_ = std::move(rule);
}

bool Scene::may_shade(SurfaceId receiver, SurfaceId caster) const {
  return receiver != caster && surfaces_[caster].casting != Casting::never &&
         rule_(receiver, caster);
}

}  // namespace gpu_shading
