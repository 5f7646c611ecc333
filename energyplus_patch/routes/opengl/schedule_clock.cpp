#include "routes/opengl/schedule_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "gpu_shading/error.h"
#include "gpu_shading/sun_position.h"
#include "runs/schedule_value.h"

namespace gpu_shading::energyplus {
namespace {

constexpr int hours_of_day = 24;

// Hours by which solar time, at a longitude, is ahead of a clock: the mean over some days.
double ahead_of_clock(ScheduleDay const& day, int day_of_year, int days) {
  constexpr int last_day = 366;
  constexpr double minutes = 60.0;
  constexpr double degrees_per_hour = 15.0;
  double sum = 0.0;
  for (int i = 0; i < days; ++i) {
    sum += sun_of_day((day_of_year + i - 1) % last_day + 1).equation_of_time;
  }
  return sum / days / minutes + day.longitude / degrees_per_hour - day.time_zone;
}

}  // namespace

ScheduleClock::ScheduleClock(ScheduleDays days, int update_days, Today today)
    : days_(std::move(days)), update_days_(update_days), today_(std::move(today)) {
  for (std::size_t i = 0; i < days_.days.size(); ++i) {
    by_date_.emplace(Date{days_.days[i].month, days_.days[i].day}, i);
  }
}

// Two periods may have the same day, as days of different types.
ScheduleDay const* ScheduleClock::find(HostedDay const& today) const {
  auto const [begin, end] = by_date_.equal_range({today.month, today.day});
  if (begin == end) return nullptr;
  auto const same = std::find_if(
      begin, end, [&](auto const& entry) { return days_.days[entry.second].type == today.type; });
  return &days_.days[same == end ? begin->second : same->second];
}

// EnergyPlus takes the sun at the end of a timestep, or at the middle of the hour where the hour is
// the timestep.
std::optional<Moment> ScheduleClock::moment_of(glm::dvec3 const& towards_sun) const {
  constexpr double noon = 12.0;
  constexpr double radians_per_hour = 0.26179938779914943654;
  auto const today = today_();
  if (!today) return std::nullopt;
  auto const* const day = find(*today);
  if (day == nullptr) return std::nullopt;
  auto const latitude = glm::radians(day->latitude);
  double const solar =
      noon + to_hour_direction(to_direction(towards_sun), latitude).hour_angle / radians_per_hour;
  double const clock =
      solar - ahead_of_clock(*day, today->day_of_year, std::min(update_days_, day->days_left));
  int const steps = days_.steps_per_hour;
  double const end = steps == 1 ? clock + 0.5 : clock * steps;
  int const all = hours_of_day * steps;
  int const step = ((static_cast<int>(std::lround(end)) - 1) % all + all) % all;
  return Moment{step / steps + 1, step % steps + 1};
}

std::size_t ScheduleClock::number_of(std::string const& schedule) const {
  auto const found = std::ranges::find(days_.schedules, schedule);
  if (found == days_.schedules.end()) {
    throw Error(fmt::format("EnergyPlus has no schedule \"{}\"", schedule));
  }
  return static_cast<std::size_t>(found - days_.schedules.begin());
}

std::pair<double, double> ScheduleClock::range(std::string const& schedule) const {
  auto const number = number_of(schedule);
  std::pair range(1.0, 0.0);
  for (auto const& day : days_.days) {
    for (std::size_t i = number; i < day.values.size(); i += days_.schedules.size()) {
      range.first = std::min(range.first, checked_share(schedule, day.values[i]));
      range.second = std::max(range.second, checked_share(schedule, day.values[i]));
    }
  }
  return range;
}

double ScheduleClock::value(std::string const& schedule, Moment moment) const {
  auto const number = number_of(schedule);
  auto const today = today_();
  auto const* const day = today ? find(*today) : nullptr;
  if (moment.timestep == 0 || day == nullptr) return range(schedule).first;
  auto const row =
      static_cast<std::size_t>((moment.hour - 1) * days_.steps_per_hour + moment.timestep - 1);
  return checked_share(schedule, day->values.at(row * days_.schedules.size() + number));
}

}  // namespace gpu_shading::energyplus
