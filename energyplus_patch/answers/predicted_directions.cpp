#include "answers/predicted_directions.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;
constexpr std::size_t patch_azimuths = sky_columns;
constexpr std::size_t patches = sky_rows * patch_azimuths;
// Tolerance of angles up to 2 pi in single precision, several times the rounding.
constexpr double rounding = 1e-6;

// Twice, so that those after any of them follow it.
std::vector<SunDirection> const& sky() {
  static auto const directions = [] {
    auto all = sky_patches();
    all.insert(all.end(), sky_patches().begin(), sky_patches().end());
    return all;
  }();
  return directions;
}

std::size_t number_of_patch(SunDirection sun) {
  auto const turns = static_cast<long>(std::lround(sun.azimuth / sky_step));
  constexpr auto around = static_cast<long>(patch_azimuths);
  auto const azimuth = static_cast<std::size_t>((turns % around + around) % around);
  auto const altitude = static_cast<std::size_t>(std::lround(sun.altitude / sky_step - 0.5));
  return altitude * patch_azimuths + azimuth;
}

bool are_same(SunDirection a, SunDirection b) {
  double const higher = std::abs(a.altitude - b.altitude);
  if (higher + std::abs(a.azimuth - b.azimuth) < rounding) return true;
  return higher <= rounding && glm::distance(to_vector(a), to_vector(b)) < rounding;
}

}  // namespace

std::span<SunDirection const> PredictedDirections::find(SunDirection sun, double latitude) const {
  constexpr double near = 2.0 * rounding;  // of two directions in single precision
  auto const now = to_hour_direction(sun, latitude);
  auto const last = by_declination_.upper_bound(now.declination + near);
  auto found = by_declination_.lower_bound(now.declination - near);
  for (; found != last; ++found) {
    auto const& day = found->second;
    double const step = std::round((now.hour_angle - day.first.hour_angle) / day.step);
    if (!(step >= 0.0 && step < static_cast<double>(day.directions.size()))) continue;
    auto const rest = std::span(day.directions).subspan(static_cast<std::size_t>(step));
    if (are_same(rest.front(), sun)) return rest;
  }
  return {};
}

SunDirection PredictedDirections::snap_to_known(SunDirection sun, Latitude const& latitude) {
  if (is_sky_patch(sun)) {
    auto const patch = number_of_patch(sun);
    ahead_ = std::span(sky()).subspan(patch + 1, patches - 1);
    return sky()[patch];
  }
  bool const as_predicted = !ahead_.empty() && are_same(ahead_.front(), sun);
  if (!as_predicted) ahead_ = by_declination_.empty() ? ahead_.first(0) : find(sun, latitude());
  if (!ahead_.empty()) {
    ++met_;
    sun = ahead_.front();
    ahead_ = ahead_.subspan(1);
  } else if (latitude && !predictions_fail()) {
    predict_day(sun, latitude());
  }
  last_ = sun;
  return sun;
}

// The timestep, from two directions of one day; EnergyPlus has 1 to 60 timesteps per hour.
void PredictedDirections::learn_step(HourDirection now, double latitude) {
  if (!last_) return;
  auto const before = to_hour_direction(*last_, latitude);
  if (std::abs(before.declination - now.declination) > rounding) return;
  double const steps = 2.0 * pi / 24.0 / (now.hour_angle - before.hour_angle);
  constexpr double max_steps = 60.0;
  constexpr double tolerance = 0.05;
  double const whole = std::round(steps);
  if (whole < 1.0 || whole > max_steps || std::abs(steps - whole) > tolerance) return;
  step_ = 2.0 * pi / 24.0 / whole;
}

bool PredictedDirections::predictions_fail() const {
  constexpr std::size_t enough = 20;
  return predicted_ > enough && 2 * met_ < predicted_;
}

void PredictedDirections::predict_day(SunDirection sun, double latitude) {
  auto now = to_hour_direction(sun, latitude);
  learn_step(now, latitude);
  if (!step_) return;
  Day day{now, *step_, {sun}};
  auto& directions = day.directions;
  std::size_t known_steps = 0;  // after the first
  for (now.hour_angle += *step_; now.hour_angle <= pi; now.hour_angle += *step_) {
    auto const next = to_direction(now, latitude);
    if (next.altitude <= 0.0) break;
    // The first day was predicted from its second direction on, and is repeated.
    auto const known = known_steps + 1 == directions.size() ? find(next, latitude)
                                                            : std::span<SunDirection const>();
    if (!known.empty()) ++known_steps;
    directions.push_back(known.empty() ? next : known.front());
  }
  predicted_ += directions.size() - 1 - known_steps;
  if (directions.size() == 1) return;
  auto const kept = by_declination_.emplace(day.first.declination, std::move(day));
  ahead_ = std::span(kept->second.directions).subspan(1);
}

}  // namespace gpu_shading::energyplus
