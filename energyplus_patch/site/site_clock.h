#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/sun_direction.h"
#include "input/input_object.h"

namespace gpu_shading::energyplus {

// What the clocks at a model's site show, to the minute.
using ClockTime = std::chrono::local_time<std::chrono::minutes>;

// A model's site and clock, by which EnergyPlus has the sun.
class SiteClock {
 public:
  // The place and the zone are Site:Location's. Daylight saving is RunPeriodControl:
  // DaylightSavingTime's, else the weather file's, where there is one and the first RunPeriod does
  // not say No to it. The year is that RunPeriod's: its own, else the last one up to 2017 in which
  // it begins on its Day of Week for Start Day, else 2017. Throws Error.
  SiteClock(std::vector<InputObject> const& objects,
            std::optional<std::filesystem::path> const& weather);

  std::chrono::year year() const { return year_; }

  // The clock is an hour ahead then; all day, on the first and the last one too.
  bool saves_daylight(ClockTime time) const;

  // As EnergyPlus has it at the end of a timestep, in any year; below the horizon at night.
  SunDirection sun(ClockTime time) const;

 private:
  double latitude_ = 0.0;     // radians
  double hours_ahead_ = 0.0;  // mean solar time less standard time
  std::chrono::year year_{2017};
  std::optional<std::pair<std::string, std::string>> saving_;  // the first and last day
};

}  // namespace gpu_shading::energyplus
