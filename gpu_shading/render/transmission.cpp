#include "render/transmission.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "gpu_shading/error.h"

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
  return {static_cast<float>(shades_.transmittance(scene_, id, towards_sun)), shades_.schedule(id)};
}

std::optional<ScheduleKeys> Transmission::keys(SurfaceId receiver,
                                               std::span<SurfaceId const> casters) const {
  std::vector<int> passed;
  for (SurfaceId const caster : casters) {
    if (shades_.schedule(caster) != Shades::unscheduled) passed.push_back(shades_.schedule(caster));
  }
  if (passed.empty()) return std::nullopt;
  auto keys = ScheduleKeys::make(passed, static_cast<int>(shades_.schedules().size()));
  if (!keys) {
    std::sort(passed.begin(), passed.end());
    auto const distinct = std::unique(passed.begin(), passed.end()) - passed.begin();
    throw Error(fmt::format(
        "surface '{}' sees the sun through {} shades with {} different transmittance schedules, "
        "too many to be told apart; let shades share schedules",
        scene_[receiver].name, passed.size(), distinct));
  }
  return keys;
}

ScreenView Transmission::see(std::span<DirectionTables const> directions, int most_texels) const {
  ScreenView all;
  for (DirectionTables const& direction : directions) {
    std::vector<int> numbers;
    for (std::size_t i = 0; i < direction.screens.size(); ++i) {
      if (direction.screens[i]) numbers.push_back(static_cast<int>(i));
    }
    ScreenView const seen = see_screens(screens_, numbers, direction.by_effect,
                                        direction.towards_sun, deployments_, most_texels);
    for (SheetBlock sheet : seen.sheets) {
      sheet.kind.z += static_cast<int>(all.regions.size());
      all.sheets.push_back(sheet);
    }
    all.regions.insert(all.regions.end(), seen.regions.begin(), seen.regions.end());
  }
  return all;
}

}  // namespace gpu_shading
