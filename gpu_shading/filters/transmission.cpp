#include "filters/transmission.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>

namespace gpu_shading {

Transmission::Transmission(Scene const& scene)
    : entries_(scene.size()), screens_(scene), crowns_(scene) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    int const schedule = scene[id].filter.schedule;
    if (schedule >= 0) schedules_.push_back(schedule);
  }
  std::sort(schedules_.begin(), schedules_.end());
  schedules_.erase(std::unique(schedules_.begin(), schedules_.end()), schedules_.end());
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    BeamFilter const& filter = scene[id].filter;
    Entry& entry = entries_[id];
    entry.transmits = filter.transmits();
    entry.is_flat = filter.is_flat();
    if (!entry.transmits) continue;
    entry.filter = filter;
    entry.normal = normal(scene[id].polygon);
    if (filter.schedule < 0) continue;
    auto const found = std::lower_bound(schedules_.begin(), schedules_.end(), filter.schedule);
    entry.schedule = static_cast<int>(found - schedules_.begin());
  }
}

bool Transmission::any_transmits(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(), [&](SurfaceId id) { return transmits(id); });
}

bool Transmission::any_schedule(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return schedule(id) != Shade::unscheduled; });
}

bool Transmission::any_body(std::span<SurfaceId const> casters) const {
  return any_screen(casters) || any_crown(casters);
}

bool Transmission::any_screen(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return screens_.number(id) != Screens::none; });
}

bool Transmission::any_crown(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return crowns_.number(id) != Crowns::none; });
}

std::string Transmission::describe(std::span<SurfaceId const> casters) const {
  std::string kinds;
  auto const add = [&](bool any, char const* kind) {
    if (any) kinds += (kinds.empty() ? "" : " and ") + std::string(kind);
  };
  add(any_screen(casters), "perforated screens");
  add(any_crown(casters), "tree crowns");
  add(any_schedule(casters), "transmittance schedules");
  return kinds.empty() ? "transparent shades" : kinds;
}

std::vector<SurfaceId> Transmission::flat_among(std::span<SurfaceId const> casters) const {
  std::vector<SurfaceId> flat;
  std::copy_if(casters.begin(), casters.end(), std::back_inserter(flat),
               [&](SurfaceId id) { return is_flat(id); });
  return flat;
}

std::vector<int> Transmission::screens_among(std::span<SurfaceId const> casters) const {
  std::vector<int> numbers;
  for (SurfaceId const id : casters) {
    if (screens_.number(id) != Screens::none) numbers.push_back(screens_.number(id));
  }
  return numbers;
}

std::vector<CrownInBeam> Transmission::crowns_among(std::span<SurfaceId const> casters,
                                                    glm::dvec3 const& towards_sun) const {
  std::vector<CrownInBeam> crowns;
  for (SurfaceId const id : casters) {
    int const number = crowns_.number(id);
    if (number == Crowns::none) continue;
    Crowns::Entry const& crown = crowns_[number];
    crowns.push_back({&crown, towards_sun, crown.extinction(towards_sun, deployments_)});
  }
  return crowns;
}

double Transmission::transmittance(SurfaceId id, glm::dvec3 const& towards_sun) const {
  Entry const& entry = entries_[id];
  if (!entry.transmits) return 0.0;
  double const cosine = std::min(1.0, std::abs(glm::dot(entry.normal, towards_sun)));
  return entry.filter.flat_factor(cosine);
}

Shade Transmission::shade(SurfaceId id, glm::dvec3 const& towards_sun) const {
  if (!transmits(id)) return {};
  return {static_cast<float>(transmittance(id, towards_sun)), schedule(id)};
}

}  // namespace gpu_shading
