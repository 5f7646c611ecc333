#include "model/site/site_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "gpu_shading/error.h"
#include "gpu_shading/sun_position.h"
#include "model/idf/fields.h"
#include "model/site/calendar_date.h"
#include "model/site/location_fields.h"
#include "model/site/weather_header.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace chrono = std::chrono;

InputObject const* find(std::vector<InputObject> const& objects, std::string_view type) {
  auto const found = std::find_if(objects.begin(), objects.end(),
                                  [&](InputObject const& object) { return object.type == type; });
  return found == objects.end() ? nullptr : &*found;
}

chrono::year year_of(InputObject const& period) {
  constexpr chrono::year usual{2017};
  if (auto const year = read(period, run_period::begin_year)) return chrono::year(*year);
  auto const month = read(period, run_period::begin_month);
  auto const day = read(period, run_period::begin_day);
  auto const weekday = weekday_of(period["day_of_week_for_start_day"]);
  if (!weekday) return usual;
  // The number of years after which weekdays repeat.
  constexpr chrono::years cycle{28};
  for (chrono::year year = usual; year > usual - cycle; --year) {
    auto const start = date_in(fmt::format("{}/{}", month, day), year);
    if (!year.is_leap() && chrono::weekday(chrono::sys_days(start)) == *weekday) return year;
  }
  return usual;
}

}  // namespace

void check_location(std::vector<InputObject> const& objects) {
  auto const* const location = find(objects, site_location::type);
  if (location == nullptr) return;
  naming(location->where(), [&] {
    for (auto const& field :
         {site_location::latitude, site_location::longitude, site_location::time_zone}) {
      read(*location, field);
    }
  });
}

SiteClock::SiteClock(std::vector<InputObject> const& objects,
                     std::optional<std::filesystem::path> const& weather) {
  auto const* const location = find(objects, site_location::type);
  if (location == nullptr) {
    throw Error("Site:Location is missing; it is required for the sun's position");
  }
  naming(location->where(), [&] {
    constexpr double degrees_an_hour = 15.0;
    latitude_ = glm::radians(read(*location, site_location::latitude));
    hours_ahead_ = read(*location, site_location::longitude) / degrees_an_hour -
                   read(*location, site_location::time_zone);
  });
  auto const* const period = find(objects, run_period::type);
  if (period != nullptr) {
    year_ = naming(period->where(), [&] { return year_of(*period); });
  }
  if (auto const* const own = find(objects, "RunPeriodControl:DaylightSavingTime")) {
    saving_ = {(*own)["start_date"], (*own)["end_date"]};
    naming(own->where(), [&] { saves_daylight({}); });
  } else if (weather && (period == nullptr ||
                         !same_name((*period)["use_weather_file_daylight_saving_period"], "No"))) {
    saving_ = read_daylight_saving(*weather);
  }
}

bool SiteClock::saves_daylight(ClockTime time) const {
  if (!saving_) return false;
  auto const day = chrono::floor<chrono::days>(time);
  auto const year = chrono::year_month_day(day).year();
  chrono::local_days const first(date_in(saving_->first, year));
  chrono::local_days const last(date_in(saving_->second, year));
  // South of the equator, it includes the turn of the year.
  return first <= last ? first <= day && day <= last : day >= first || day <= last;
}

SunDirection SiteClock::sun(ClockTime time) const {
  auto const standard = time - chrono::hours(saves_daylight(time) ? 1 : 0);
  auto const midnight = chrono::floor<chrono::days>(standard);
  chrono::local_days const new_year(chrono::year_month_day(midnight).year() / chrono::January / 1);
  auto const sun = sun_of_day(static_cast<int>((midnight - new_year).count()) + 1);
  constexpr double minutes_of_hour = 60.0;
  constexpr double noon = 12.0;
  constexpr double half_turn = 12.0;
  double const hours = static_cast<double>((standard - midnight).count()) / minutes_of_hour;
  double const past_noon = hours + hours_ahead_ + sun.equation_of_time / minutes_of_hour - noon;
  double const turn = past_noon / half_turn * std::numbers::pi;
  return to_direction(HourDirection{sun.declination, std::remainder(turn, 2.0 * std::numbers::pi)},
                      latitude_);
}

}  // namespace gpu_shading::energyplus
