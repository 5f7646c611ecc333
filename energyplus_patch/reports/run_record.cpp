#include "reports/run_record.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t hours_of_day = 24;
// Of all days that are kept: 64 MB.
constexpr std::size_t max_values = std::size_t{1} << 24U;
constexpr float behind = -1.0F;
constexpr double watt_hours = 1000.0;  // per kWh

}  // namespace

double ReceivedLight::of_month(Kind kind, std::size_t month) const {
  double sum = 0.0;
  for (std::size_t hour = 0; hour < hours_; ++hour) sum += at(kind, month, hour);
  return sum;
}

double ReceivedLight::of_run(Kind kind) const {
  double sum = 0.0;
  for (std::size_t month = 0; month < months; ++month) sum += of_month(kind, month);
  return sum;
}

RunRecord::RunRecord(std::vector<glm::dvec3> areas, std::vector<SurfaceId> receivers)
    : areas_(std::move(areas)), receivers_(std::move(receivers)), places_(areas_.size()) {
  for (std::size_t i = 0; i < receivers_.size(); ++i) places_[receivers_[i]] = i;
}

bool RunRecord::counts() const {
  return day_ && !day_->warm_up && day_->kind != RunDay::Kind::other && day_->month >= 1 &&
         day_->month <= static_cast<int>(ReceivedLight::months);
}

void RunRecord::make_room(Period& period) const {
  constexpr std::size_t max_hourly = 4000;  // 40 MB
  period.light.resize(receivers_.size(),
                      ReceivedLight(receivers_.size() > max_hourly ? 1 : hours_of_day));
}

void RunRecord::begin_day(RunDay const& day, Beam const& beam) {
  bool const same = day_ && day_->environment == day.environment && day_->month == day.month &&
                    day_->day == day.day && day_->warm_up == day.warm_up;
  if (same && !day.warm_up) return;  // another timestep of it
  end_day();
  day_ = day;
  step_ = nullptr;
  if (counts()) {
    beam_ = beam();
    make_room(period());
  } else {
    beam_.clear();
  }
}

void RunRecord::begin_step(Moment moment, std::vector<float> shares) {
  step_ = nullptr;
  if (!day_ || moment.hour < 1 || moment.timestep < 1) return;
  auto const per_hour = static_cast<std::size_t>(day_->steps_per_hour);
  auto const step = static_cast<std::size_t>(moment.timestep) - 1;
  auto const hour = static_cast<std::size_t>(moment.hour) - 1;
  if (step >= per_hour || hour >= hours_of_day) return;
  if (!has_new_steps_) steps_.assign(hours_of_day * per_hour, {});
  has_new_steps_ = true;
  step_ = &steps_[hour * per_hour + step];
  *step_ = {std::nullopt, {}, std::move(shares)};
}

void RunRecord::set_sun(SunDirection sun) {
  // With schedules, EnergyPlus goes through the patches of the sky at a timestep, too.
  if (step_ == nullptr || is_sky_patch(sun)) {
    step_ = nullptr;
    return;
  }
  towards_sun_ = to_vector(sun);
  step_->sun = sun;
  // EnergyPlus does not ask about receivers that nothing can shade.
  step_->fractions.clear();
  for (auto const receiver : receivers_) {
    step_->fractions.push_back(glm::dot(areas_[receiver], towards_sun_) > 0.0 ? 1.0F : behind);
  }
}

void RunRecord::note(SurfaceId receiver, double projected_area) {
  if (step_ == nullptr || !places_[receiver]) return;
  double const unshaded = glm::dot(areas_[receiver], towards_sun_);
  if (unshaded <= 0.0) return;
  step_->fractions[*places_[receiver]] =
      static_cast<float>(std::clamp(projected_area / unshaded, 0.0, 1.0));
}

void RunRecord::note_diffuse(int hour, std::vector<DiffuseLight> const& light) {
  if (!counts()) return;
  period().has_diffuse = true;
  auto const month = static_cast<std::size_t>(day_->month) - 1;
  auto const from_0 = static_cast<std::size_t>(hour) - 1;
  double const hours = 1.0 / day_->steps_per_hour / watt_hours;
  for (std::size_t i = 0; i < light.size(); ++i) {
    auto const& [sky, by_ground, by_shades] = light[i];
    auto& received = period().light[i];
    received.add(ReceivedLight::sky, month, from_0, sky * hours);
    received.add(ReceivedLight::by_ground, month, from_0, by_ground * hours);
    received.add(ReceivedLight::by_shades, month, from_0, by_shades * hours);
  }
}

void RunRecord::end() {
  end_day();
  day_.reset();
  for (auto* const period : {&run_period_, &design_days_}) share_beam(*period);
  make_room(of_design_days() ? design_days_ : run_period_);
}

void RunRecord::end_day() {
  if (!day_ || day_->kind == RunDay::Kind::other) return;
  if (has_new_steps_) keep_day();
  if (counts()) {
    ++period().simulated;
    ++period().days_of_months.at(static_cast<std::size_t>(day_->month) - 1);
    add_beam();
    add_normal_beam();
  }
}

void RunRecord::add_beam() {
  auto const month = static_cast<std::size_t>(day_->month) - 1;
  auto const per_hour = static_cast<std::size_t>(day_->steps_per_hour);
  auto const steps = std::min(steps_.size(), beam_.size());
  for (std::size_t i = 0; i < steps; ++i) {
    if (!steps_[i].sun || beam_[i] <= 0.0) continue;
    auto const towards_sun = to_vector(*steps_[i].sun);
    double const energy = beam_[i] / day_->steps_per_hour / watt_hours;
    for (std::size_t k = 0; k < receivers_.size(); ++k) {
      float const fraction = steps_[i].fractions[k];
      if (fraction <= 0.0F) continue;
      auto const& area = areas_[receivers_[k]];
      period().light[k].add(ReceivedLight::beam, month, i / per_hour,
                            energy * fraction * glm::dot(area, towards_sun) / glm::length(area));
    }
  }
}

void RunRecord::add_normal_beam() {
  auto& period = this->period();
  auto const per_hour = static_cast<std::size_t>(day_->steps_per_hour);
  for (std::size_t i = 0; i < std::min(beam_.size(), hours_of_day * per_hour); ++i) {
    period.normal_beam.at(i / per_hour) += beam_[i] / day_->steps_per_hour;
  }
  ++period.beam_days;
}

// Gives the day whose answers held the mean beam of the days since.
void RunRecord::share_beam(Period& period) {
  if (period.beam_days > 0 && period.last < period.days.size()) {
    for (auto& hour : period.days[period.last].hours) {
      hour.beam = period.normal_beam.at(static_cast<std::size_t>(hour.hour) - 1) / period.beam_days;
    }
  }
  period.normal_beam = {};
  period.beam_days = 0;
}

bool RunRecord::is_faced(std::size_t receiver, std::size_t step) const {
  auto const& taken = steps_[step];
  return taken.sun && taken.sun->altitude > 0.0 && taken.fractions[receiver] >= 0.0F;
}

RunRecord::WholeHours RunRecord::whole_hours(std::size_t receiver) const {
  // The mean cosine of an hour during which the sun goes behind a plane and comes back is less than
  // 1 - cos(15 degrees).
  constexpr double returning = 0.034074173710931713;
  auto const per_hour = static_cast<std::size_t>(day_->steps_per_hour);
  auto const& area = areas_[receivers_[receiver]];
  WholeHours whole;
  for (std::size_t hour = 1; hour + 1 < hours_of_day; ++hour) {
    auto const first = hour * per_hour;
    if (!is_faced(receiver, first - 1) || !is_faced(receiver, first + per_hour)) continue;
    double cosines = 0.0;
    float fractions = 0.0F;
    std::size_t faced = 0;
    for (auto step = first; step < first + per_hour && is_faced(receiver, step); ++step, ++faced) {
      cosines += glm::dot(area, to_vector(*steps_[step].sun));
      fractions += steps_[step].fractions[receiver];
    }
    auto const steps = static_cast<double>(per_hour);
    if (faced < per_hour || cosines < returning * steps * glm::length(area)) continue;
    whole.sum += fractions / static_cast<float>(per_hour);
    ++whole.count;
  }
  return whole;
}

// In place of the same day of a warm-up.
void RunRecord::keep_day() {
  has_new_steps_ = false;
  Day day{day_->month, day_->day, {}, {}};
  auto const per_hour = static_cast<std::size_t>(day_->steps_per_hour);
  for (std::size_t hour = 0; hour < hours_of_day; ++hour) {
    auto const& step = steps_[(hour + 1) * per_hour - 1];
    if (step.sun && step.sun->altitude > 0.0) {
      day.hours.push_back(
          {static_cast<int>(hour + 1), *step.sun, step.fractions, 0.0, step.shares});
    }
  }
  for (std::size_t i = 0; i < receivers_.size(); ++i) day.whole.push_back(whole_hours(i));
  auto& period = this->period();
  auto const found = std::ranges::find_if(period.days, [&](Day const& other) {
    return other.month == day.month && other.day == day.day;
  });
  if (found != period.days.end()) {
    share_beam(period);
    *found = std::move(day);
    period.last = static_cast<std::size_t>(found - period.days.begin());
    return;
  }
  if (period.offered++ % period.stride != 0) return;
  share_beam(period);
  period.values += day.hours.size() * receivers_.size();
  period.days.push_back(std::move(day));
  while (period.values > max_values && period.days.size() > 1) {
    std::vector<Day> fewer;
    period.values = 0;
    for (std::size_t i = 0; i < period.days.size(); i += 2) {
      period.values += period.days[i].hours.size() * receivers_.size();
      fewer.push_back(std::move(period.days[i]));
    }
    period.days = std::move(fewer);
    period.stride *= 2;
  }
  period.last = period.days.size() - 1;
}

}  // namespace gpu_shading::energyplus
