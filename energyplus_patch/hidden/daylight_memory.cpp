#include "hidden/daylight_memory.h"

namespace gpu_shading::energyplus {

void DaylightMemory::note_shadows(int hour) {
  ++shadows_;
  last_hour_ = hour;
}

void DaylightMemory::begin(bool rays_hold) {
  hour_.reset();
  bool const is_hour = last_hour_ >= 1 && last_hour_ <= static_cast<int>(hours);
  if (shadows_ == 1 && is_hour) hour_ = last_hour_;
  shadows_ = 0;
  sun_ = false;
  rays_ = nullptr;
  rays_hold_ = rays_hold;
  if (!rays_hold) rays_of_.clear();
  reflected_ = {};
  reflected_now_ = nullptr;
  obstructions_ = {};
  skies_.clear();
  luminances_of_.clear();
}

// In the dark, EnergyPlus sets the factors of the hour and all else to zero, follows all rays
// nevertheless, and then adds nothing. It also notes that the sun has set, for all points of a
// kind.
bool DaylightMemory::begin_points(Points points, bool sun_in_weather) {
  bool const dark = is_dark(sun_in_weather);
  auto& zeros = zeros_[points];
  auto const hour = static_cast<std::size_t>(hour_.value_or(0));
  if (dark && zeros.now && zeros.of_hour[hour]) return false;
  if (dark) {
    zeros.now = true;
    zeros.of_hour.set(hour);
  } else {
    for (auto& [other, of_other] : zeros_) {
      if (other.first == points.first) of_other.now = false;
    }
    if (hour_) {
      zeros.of_hour.reset(hour);
    } else {
      zeros.of_hour.reset();
    }
  }
  if (rays_hold_) {
    rays_ = &rays_of_.try_emplace(points, room_for_rays_).first->second;
    rays_->restart();
  }
  return true;
}

bool DaylightMemory::begin_reflected(Reflected const& reflected) {
  reflected_now_ = nullptr;
  bool const is_hour = reflected.hour >= 1 && reflected.hour <= static_cast<int>(hours);
  if (!is_hour) return true;
  auto& kept = reflected_.at(static_cast<std::size_t>(reflected.hour));
  auto const obstructions = reflected.first ? reflected : obstructions_;
  bool const known = kept && kept->reflected == reflected && kept->obstructions == obstructions &&
                     obstructions_ == obstructions;
  if (known) return false;
  obstructions_ = obstructions;
  kept = KeptReflected{reflected, obstructions};
  reflected_now_ = &kept;
  return true;
}

void DaylightMemory::note_sums() {
  if (reflected_now_ != nullptr) reflected_now_->reset();
}

DaylightMemory::Rays::Question DaylightMemory::question(Ray kind, int window,
                                                        glm::dvec3 const& from,
                                                        glm::dvec3 const& to) {
  constexpr unsigned bits_of_window = 32;
  auto const what =
      (static_cast<std::uint64_t>(kind) << bits_of_window) + static_cast<std::uint32_t>(window);
  return {what,          bits_of(from.x), bits_of(from.y), bits_of(from.z),
          bits_of(to.x), bits_of(to.y),   bits_of(to.z)};
}

bool DaylightMemory::sky_recurs(int hour, int window) {
  if (recurring_skies_.contains(window)) return true;
  if (skies_.insert({hour, window}).second) return false;
  recurring_skies_.insert(window);
  return true;
}

DaylightMemory::SkyOfWindow::SkyOfWindow(DaylightMemory& memory, int hour, int window)
    : memory_(memory), before_(memory.luminances_) {
  auto const place = memory.luminances_of_.try_emplace({hour, window}, memory.room_for_luminances_);
  memory.luminances_ = &place.first->second;
  memory.luminances_->restart();
  memory.untested_ = true;
}

}  // namespace gpu_shading::energyplus
