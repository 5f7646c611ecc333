#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "model/idf/input_object.h"
#include "model/site/weather_header.h"

namespace gpu_shading::energyplus {

// Clock time at a model's site, to the minute.
using ClockTime = std::chrono::local_time<std::chrono::minutes>;

// The model's Site:Location. Throws Error if there is none, or for its fields.
WeatherSite read_site(std::vector<InputObject> const& objects);

// Throws Error if Site:Location has coordinates or a time zone outside of the dictionary's limits
// or nan, which EnergyPlus accepts.
void check_location(std::vector<InputObject> const& objects);

// The day of a year from the notations of EnergyPlus's objects and weather files: "4/30" (month
// first), "30 April", "Apr 30", "2nd Sunday in March", "Last Sunday in October". Throws Error.
std::chrono::year_month_day date_in(std::string_view text, std::chrono::year year);

// "Sunday" or its first three letters, in any case.
std::optional<std::chrono::weekday> weekday_of(std::string_view word);

// Mean solar time minus standard time, hours.
double hours_ahead(WeatherSite const& site);

// EnergyPlus's sun position on a day of the year, 1 .. 366, at an hour of standard time, which mean
// solar time is ahead of by `hours_ahead`. Latitude in radians.
SunDirection sun_in_standard_time(double latitude, double hours_ahead, int day, double hours);

// A model's site and clock, from which EnergyPlus computes the sun's position.
class SiteClock {
 public:
  // The location and the time zone are those of Site:Location. Daylight saving time is that of
  // RunPeriodControl:DaylightSavingTime, or that of the weather file, if there is one, unless the
  // first RunPeriod excludes it. The year is that RunPeriod's: its own, or the last one up to 2017
  // in which it begins on its Day of Week for Start Day, or 2017. Throws Error.
  SiteClock(std::vector<InputObject> const& objects,
            std::optional<std::filesystem::path> const& weather);

  std::chrono::year year() const { return year_; }

  // Whether the clock is an hour ahead, which it is for whole days, including the first and the
  // last one.
  bool saves_daylight(ClockTime time) const;

  // EnergyPlus's sun position at the end of a timestep, in any year; below the horizon at night.
  SunDirection sun(ClockTime time) const;

 private:
  double latitude_ = 0.0;     // radians
  double hours_ahead_ = 0.0;  // mean solar time minus standard time
  std::chrono::year year_{2017};
  std::optional<std::pair<std::string, std::string>> saving_;  // the first and last day
};

}  // namespace gpu_shading::energyplus
