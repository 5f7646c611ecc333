#include "filters/transmittance/shades.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gpu_shading/transmittance.h"

namespace gpu_shading {

Shades::Shades(Scene const& scene) : entries_(scene.size()) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface const& surface = scene[id];
    if (surface.schedule >= 0) schedules_.push_back(surface.schedule);
  }
  std::sort(schedules_.begin(), schedules_.end());
  schedules_.erase(std::unique(schedules_.begin(), schedules_.end()), schedules_.end());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface const& surface = scene[id];
    Entry& entry = entries_[id];
    bool const is_shade = surface.transmittance != nullptr || surface.schedule >= 0;
    entry.transmits = is_shade || surface.screen != nullptr;
    entry.dims = is_shade || surface.screen == nullptr;
    if (!entry.transmits) continue;
    any_ = true;
    entry.model = surface.transmittance;
    entry.normal = normal(surface.polygon);
    if (surface.schedule < 0) continue;
    auto const found = std::lower_bound(schedules_.begin(), schedules_.end(), surface.schedule);
    entry.schedule = static_cast<int>(found - schedules_.begin());
  }
}

double Shades::transmittance(SurfaceId id, glm::dvec3 const& towards_sun) const {
  Entry const& entry = entries_[id];
  if (!entry.transmits) return 0.0;
  if (!entry.model) return 1.0;
  double const cosine = std::min(1.0, std::abs(glm::dot(entry.normal, towards_sun)));
  return std::clamp((*entry.model)(std::acos(cosine)), 0.0, 1.0);
}

}  // namespace gpu_shading
