#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// Clock time at a model's site, to the minute.
using ClockTime = std::chrono::local_time<std::chrono::minutes>;

// Throws Error if Site:Location, where there is one, has coordinates or a time zone that are no
// numbers within the dictionary's limits: EnergyPlus accepts nan.
void check_location(std::vector<InputObject> const& objects);

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
