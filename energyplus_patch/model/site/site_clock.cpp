#include "model/site/site_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/sun_position.h"
#include "model/idf/fields.h"
#include "model/site/location_fields.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace chrono = std::chrono;

constexpr double minutes_of_hour = 60.0;

InputObject const* find(std::vector<InputObject> const& objects, std::string_view type) {
  auto const found =
      std::ranges::find_if(objects, [&](InputObject const& object) { return object.type == type; });
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

// Runs of letters and runs of digits; "1st" is two.
std::vector<std::string> words_of(std::string_view text) {
  auto const kind = [](char c) {
    auto const letter = static_cast<unsigned char>(c);
    return std::isdigit(letter) != 0 ? 1 : std::isalpha(letter) != 0 ? 2 : 0;
  };
  std::vector<std::string> words;
  int last = 0;
  for (char const c : text) {
    if (kind(c) != 0) {
      if (kind(c) != last) words.emplace_back();
      words.back() += c;
    }
    last = kind(c);
  }
  return words;
}

std::optional<unsigned> number_of(std::string const& word) {
  constexpr std::size_t max_digits = 4;
  if (word.size() > max_digits || std::isdigit(static_cast<unsigned char>(word.front())) == 0)
    return {};
  return static_cast<unsigned>(std::strtoul(word.c_str(), nullptr, 10));
}

// Index of a month or weekday by its first three letters, from 0.
template <std::size_t count>
std::optional<unsigned> index_in(std::array<char const*, count> const& names,
                                 std::string_view word) {
  for (unsigned i = 0; i < count; ++i) {
    if (same_name(word.substr(0, 3), names.at(i))) return i;
  }
  return {};
}

std::optional<chrono::month> month_of(std::string const& word) {
  static constexpr std::array<char const*, 12> names{"jan", "feb", "mar", "apr", "may", "jun",
                                                     "jul", "aug", "sep", "oct", "nov", "dec"};
  auto const found = index_in(names, word);
  return found ? std::optional(chrono::month(*found + 1)) : std::nullopt;
}

// "[2] [nd] Sunday in March", or "Last" instead of the number.
std::optional<chrono::year_month_day> weekday_in(std::vector<std::string> const& words,
                                                 chrono::year year) {
  if (words.size() < 4 || !same_name(words[words.size() - 2], "in")) return {};
  auto const weekday = weekday_of(words[words.size() - 3]);
  auto const month = month_of(words.back());
  if (!weekday || !month) return {};
  if (same_name(words.front(), "last")) {
    return chrono::year_month_day(chrono::sys_days(year / *month / (*weekday)[chrono::last]));
  }
  auto const nth = number_of(words.front());
  if (!nth || *nth < 1 || *nth > 5) return {};
  auto const day = year / *month / (*weekday)[*nth];
  return day.ok() ? std::optional(chrono::year_month_day(chrono::sys_days(day))) : std::nullopt;
}

std::optional<chrono::year_month_day> read(std::vector<std::string> const& words,
                                           chrono::year year) {
  if (words.size() == 2) {
    auto const first = number_of(words[0]);
    auto const second = number_of(words[1]);
    if (first && second) return year / chrono::month(*first) / chrono::day(*second);
    auto const month = month_of(words[first ? 1 : 0]);
    auto const day = first ? first : second;
    if (month && day) return year / *month / chrono::day(*day);
  }
  return weekday_in(words, year);
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

WeatherSite read_site(std::vector<InputObject> const& objects) {
  auto const* const location = find(objects, site_location::type);
  if (location == nullptr) {
    throw Error("Site:Location is missing; it is required for the sun's position");
  }
  return naming(location->where(), [&] {
    return WeatherSite{(*location)["name"], read(*location, site_location::latitude),
                       read(*location, site_location::longitude),
                       read(*location, site_location::time_zone),
                       read(*location, site_location::elevation)};
  });
}

double hours_ahead(WeatherSite const& site) {
  constexpr double degrees_an_hour = 15.0;
  return site.longitude / degrees_an_hour - site.time_zone;
}

SiteClock::SiteClock(std::vector<InputObject> const& objects,
                     std::optional<std::filesystem::path> const& weather) {
  auto const site = read_site(objects);
  latitude_ = glm::radians(site.latitude);
  hours_ahead_ = hours_ahead(site);
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
  double const hours = static_cast<double>((standard - midnight).count()) / minutes_of_hour;
  return sun_in_standard_time(latitude_, hours_ahead_,
                              static_cast<int>((midnight - new_year).count()) + 1, hours);
}

SunDirection sun_in_standard_time(double latitude, double hours_ahead, int day, double hours) {
  auto const sun = sun_of_day(day);
  constexpr double noon = 12.0;
  constexpr double half_turn = 12.0;
  double const past_noon = hours + hours_ahead + sun.equation_of_time / minutes_of_hour - noon;
  double const turn = past_noon / half_turn * std::numbers::pi;
  return to_direction(HourDirection{sun.declination, std::remainder(turn, 2.0 * std::numbers::pi)},
                      latitude);
}

std::optional<chrono::weekday> weekday_of(std::string_view word) {
  static constexpr std::array<char const*, 7> names{"sun", "mon", "tue", "wed",
                                                    "thu", "fri", "sat"};
  auto const found = index_in(names, word);
  return found ? std::optional(chrono::weekday(*found)) : std::nullopt;
}

std::chrono::year_month_day date_in(std::string_view text, std::chrono::year year) {
  auto const date = read(words_of(text), year);
  if (!date || !date->ok()) {
    throw Error(fmt::format(
        "\"{}\" is not a day of {}, expected one as in 4/30, 30 April or Last Sunday in October",
        text, static_cast<int>(year)));
  }
  return *date;
}

}  // namespace gpu_shading::energyplus
