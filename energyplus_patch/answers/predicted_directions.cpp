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

std::optional<PredictedDirections::DayStep> PredictedDirections::find(SunDirection sun) const {
  auto const last = by_altitude_.upper_bound(sun.altitude + rounding);
  for (auto found = by_altitude_.lower_bound(sun.altitude - rounding); found != last; ++found) {
    auto const [day, step] = found->second;
    if (are_same(days_[day][step], sun)) return found->second;
  }
  return std::nullopt;
}

SunDirection PredictedDirections::snap_to_known(SunDirection sun, Latitude const& latitude) {
  if (is_sky_patch(sun)) {
    auto const patch = number_of_patch(sun);
    ahead_ = std::span(sky()).subspan(patch + 1, patches - 1);
    return sky()[patch];
  }
  if (!ahead_.empty() && are_same(ahead_.front(), sun)) {
    ++met_;
    sun = ahead_.front();
    ahead_ = ahead_.subspan(1);
  } else if (auto const found = find(sun)) {
    auto const& day = days_[found->day];
    ++met_;
    ahead_ = std::span(day).subspan(found->step + 1);
    sun = day[found->step];
  } else {
    ahead_ = {};
    if (latitude && !predictions_fail()) predict_day(sun, latitude());
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
  Day day{sun};
  std::size_t known_steps = 0;  // after the first
  for (now.hour_angle += *step_; now.hour_angle <= pi; now.hour_angle += *step_) {
    auto const next = to_direction(now, latitude);
    if (next.altitude <= 0.0) break;
    // The first day was predicted from its second direction on, and is repeated.
    auto const known = known_steps + 1 == day.size() ? find(next) : std::nullopt;
    if (known) ++known_steps;
    day.push_back(known ? days_[known->day][known->step] : next);
  }
  predicted_ += day.size() - 1 - known_steps;
  if (day.size() == 1) return;
  days_.push_back(std::move(day));
  auto const& kept = days_.back();
  for (std::size_t step = 0; step < kept.size(); ++step) {
    if (step > 0 && step <= known_steps) continue;
    by_altitude_.emplace(kept[step].altitude, DayStep{days_.size() - 1, step});
  }
  ahead_ = std::span(kept).subspan(1);
}

}  // namespace gpu_shading::energyplus
