#include "filters/transmission.h"

#include <algorithm>
#include <iterator>

namespace gpu_shading {

bool Transmission::any_transmits(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return shades_.transmits(id); });
}

bool Transmission::any_schedule(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return shades_.schedule(id) != Shades::unscheduled; });
}

bool Transmission::any_screen(std::span<SurfaceId const> casters) const {
  return std::any_of(casters.begin(), casters.end(),
                     [&](SurfaceId id) { return screens_.number(id) != Screens::none; });
}

std::vector<SurfaceId> Transmission::plain_among(std::span<SurfaceId const> casters) const {
  std::vector<SurfaceId> plain;
  std::copy_if(casters.begin(), casters.end(), std::back_inserter(plain),
               [&](SurfaceId id) { return shades_.dims(id); });
  return plain;
}

std::vector<int> Transmission::screens_among(std::span<SurfaceId const> casters) const {
  std::vector<int> numbers;
  for (SurfaceId const id : casters) {
    if (screens_.number(id) != Screens::none) numbers.push_back(screens_.number(id));
  }
  return numbers;
}

Shade Transmission::shade(SurfaceId id, glm::dvec3 const& towards_sun) const {
  if (!shades_.transmits(id)) return {};
  return {static_cast<float>(shades_.transmittance(id, towards_sun)), shades_.schedule(id)};
}

}  // namespace gpu_shading
