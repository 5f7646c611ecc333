#pragma once

#include <string>
#include <vector>

#include "model/site/site_clock.h"

namespace gpu_shading::energyplus {

// A time to draw.
struct SunTime {
  std::string caption;  // "06-21 15:00"
  SunDirection sun;     // above the horizon
};

// "MM-DD HH:MM" in the site's clock time, optionally preceded by a year and a hyphen. Throws Error
// if it is invalid, or if the sun is down.
SunTime sun_time(std::string const& text, SiteClock const& clock);

// The multiples of the step in clock time from sunrise to sunset of "MM-DD", optionally with a
// year. Throws Error if it is not a day, or if the sun does not rise.
std::vector<SunTime> sun_times(std::string const& text, SiteClock const& clock,
                               std::chrono::minutes step);

}  // namespace gpu_shading::energyplus
