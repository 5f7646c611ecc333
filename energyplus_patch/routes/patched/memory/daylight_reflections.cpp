#include "routes/patched/memory/daylight_reflections.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

double constexpr unlimited = std::numeric_limits<double>::infinity();

}  // namespace

void DaylightReflections::begin_period() {
  undim_sun();
  images_.clear();
  if (surfaces_) surfaces_->renew();
}

void DaylightReflections::end_period() {
  settle();
  undim_sun();
}

// EnergyPlus keeps them by hour, of which it does not tell the number here, but the sun's height.
void DaylightReflections::add_horizontal(Illuminance& at) {
  std::vector<Illuminance*> possible;
  for (int hour = 1; hour <= static_cast<int>(hours); ++hour) {
    auto const sun = solar_.sun(hour);
    if (sun && std::abs(sun->z - at.sun) < 1e-9) possible.push_back(&at - (hour - 1));
  }
  if (first_hour_.empty()) {
    first_hour_ = possible;
    return;
  }
  std::erase_if(first_hour_, [&](Illuminance* each) {
    return std::ranges::find(possible, each) == possible.end();
  });
  expect(!first_hour_.empty());
}

Illuminance* DaylightReflections::horizontal(int hour) const {
  expect(first_hour_.size() == 1);
  return first_hour_.front() + (hour - 1);
}

SurfaceLuminance::Ray DaylightReflections::ray_now(State& state, int hour,
                                                   Vector const& ray) const {
  return {state, window_, hour, to_glm(ray), *horizontal(hour)};
}

void DaylightReflections::closest(State& state, Vector const& from, Vector const& ray, int& surface,
                                  Vector& hit) {
  if (measured_) {
    surface = measured_->number;
    hit = from;
    return;
  }
  original_.closest(state, from, ray, surface, hit);
  seen_.reset();
  if (!surfaces_) return;
  double const distance = surface > 0 ? glm::length(to_glm(hit) - to_glm(from)) : unlimited;
  Seen const seen{{to_glm(from), to_glm(ray), distance}, surface, hit};
  if (!hidden().meets(seen.ray)) return;
  seen_ = seen;
  surface = surfaces_->placeholder();
}

double DaylightReflections::sun_luminance(State& state, int hour, Vector const& ray, int surface,
                                          Vector const& hit) {
  if (measured_) {
    if (measured_->at != nullptr) *measured_->at = measured_->value;
    return 1.0;
  }
  auto const to_sun = solar_.sun(hour);
  // What EnergyPlus's own surface reflects of the sun, dimmed by what hidden casters take of it.
  auto const own = [&](int number, Vector const& at) {
    double const luminance = original_.sun_luminance(state, hour, ray, number, at);
    if (luminance <= 0.0 || !to_sun) return luminance;
    return luminance * hidden().transmittance({to_glm(at), *to_sun}, hour);
  };
  if (!seen_ || surface != surfaces_->placeholder() || !to_sun) return own(surface, hit);

  auto view = hidden().view(seen_->ray, hour, *to_sun);
  auto const at = ray_now(state, hour, ray);
  if (view.passed > 0.0 && seen_->surface > 0) {
    view.sun += view.passed * own(seen_->surface, seen_->hit);
    view.sky += view.passed * surfaces_->sky(at, seen_->surface);
  }
  surfaces_->set_placeholder(at, view.sky);
  return view.sun;
}

double DaylightReflections::sky_on_ground(State& state, Vector const& point, int altitudes,
                                          int azimuths) {
  double const own = original_.sky_on_ground(state, point, altitudes, azimuths);
  dim_sun(to_glm(point));
  return hidden().sky_on_ground(to_glm(point)).value_or(own);
}

void DaylightReflections::dim_sun(glm::dvec3 const& ground) {
  if (first_hour_.size() != 1) return;
  bool const one = inter_reflected_hour_ > 0;
  int const first = one ? inter_reflected_hour_ : 1;
  int const last = one ? inter_reflected_hour_ : static_cast<int>(hours);
  for (int hour = first; hour <= last; ++hour) {
    auto const to_sun = solar_.sun(hour);
    if (to_sun) dim_sun(hour, hidden().transmittance({ground, *to_sun}, hour));
  }
}

void DaylightReflections::dim_sun(int hour, double share) {
  if (share >= 1.0) return;
  double& sun = horizontal(hour)->sun;
  dimmed_.push_back({hour, share, sun});
  sun *= share;
}

void DaylightReflections::undim_sun() {
  for (auto const& dimmed : dimmed_) horizontal(dimmed.hour)->sun = dimmed.sun;
  dimmed_.clear();
}

void DaylightReflections::begin_ray(Vector const& direction) {
  // Rays to the sun's disk come between those to the ground and what EnergyPlus makes of them.
  if (inter_reflected_hour_ > 0 || direction.z <= 0.0) undim_sun();
}

void DaylightReflections::begin_factors() {
  settle();
  undim_sun();
}

// EnergyPlus calls it for each window before all rays through that window.
void DaylightReflections::inter_reflected(State& state, int sun_position, int hour, int enclosure,
                                          int window) {
  settle();
  window_ = window;
  auto const of_ray = dimmed_;
  undim_sun();
  if (!surfaces_) {
    Vector const any{1.0, 0.0, 0.0};
    surfaces_.emplace(ray_now(state, hour, any), solar_.memory(), session_, classes_,
                      original_.element, measured_);
  }
  inter_reflected_hour_ = hour;
  original_.inter_reflected(state, sun_position, hour, enclosure, window);
  inter_reflected_hour_ = 0;
  undim_sun();
  for (auto const& dimmed : of_ray) dim_sun(dimmed.hour, dimmed.share);
}

// In which directions a window may see the sun's images.
std::vector<DaylightReflections::Image> const& DaylightReflections::images(int window) {
  auto const [place, added] = images_.try_emplace(window);
  if (!added) return place->second;
  for (auto const mirror : solar_.mirrors_of(window)) {
    auto const facing = normal(session_.surface(mirror).polygon);
    for (int hour = 1; hour <= static_cast<int>(hours); ++hour) {
      auto const to_sun = solar_.sun(hour);
      if (!to_sun) continue;
      auto const direction = *to_sun - 2.0 * glm::dot(*to_sun, facing) * facing;
      if (direction.z > 0.0) place->second.push_back({direction, hour, mirror});
    }
  }
  return place->second;
}

std::optional<bool> DaylightReflections::stops_image(int window, Vector const& from,
                                                     Vector const& to) {
  settle();
  if (!surfaces_) return std::nullopt;
  auto const& possible = images(window);
  if (possible.empty()) return std::nullopt;
  auto const origin = to_glm(from);
  auto const direction = glm::normalize(to_glm(to) - origin);
  // EnergyPlus hands over vertices in single precision.
  constexpr double tolerance = 1e-4;
  Image const* seen = nullptr;
  double nearest = unlimited;
  for (auto const& image : possible) {
    if (glm::length(image.direction - direction) > tolerance) continue;
    auto const distance = solar_.distance_to_mirror(image.mirror, {origin, direction});
    if (!distance || *distance >= nearest) continue;
    nearest = *distance;
    seen = &image;
  }
  if (seen == nullptr) return std::nullopt;
  double passed = hidden().transmittance({origin, direction, nearest}, seen->hour);
  if (passed > 0.0) {
    auto const at = origin + nearest * direction;
    passed *= hidden().transmittance({at, *solar_.sun(seen->hour)}, seen->hour);
  }
  if (passed <= 0.0) return true;
  if (passed < 1.0) {
    added_ = {seen->hour, passed, surfaces_->direct(seen->hour), surfaces_->window(seen->hour)};
  }
  return false;
}

// Dims what EnergyPlus has added for an image.
void DaylightReflections::settle() {
  if (!added_) return;
  auto const [hour, passed, direct_before, window_before] = *added_;
  added_.reset();
  auto& direct = surfaces_->direct(hour);
  auto& window = surfaces_->window(hour);
  std::array<double, 2> added{};
  for (std::size_t cover = 0; cover < added.size(); ++cover) {
    added[cover] = direct[cover].sun_disk - direct_before[cover].sun_disk;
    direct[cover].sun_disk -= (1.0 - passed) * added[cover];
  }
  double const glare = window[0].sun_disk - window_before[0].sun_disk;
  window[0].sun_disk -= (1.0 - passed) * glare;
  // EnergyPlus also adds the light of the shade itself to the second.
  if (added[0] > 0.0) window[1].sun_disk -= (1.0 - passed) * glare * added[1] / added[0];
}

}  // namespace gpu_shading::energyplus
