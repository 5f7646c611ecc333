#pragma once

#include <string>
#include <vector>

#include "site/site_clock.h"

namespace gpu_shading::energyplus {

// A time that is drawn.
struct SunTime {
  std::string caption;  // "06-21 15:00"
  SunDirection sun;     // above the horizon
};

// "MM-DD HH:MM" by the site's clock, a year and a hyphen before it at will. Throws Error where it
// is none, and where the sun is down.
SunTime sun_time(std::string const& text, SiteClock const& clock);

// From sunrise to sunset of "MM-DD", or with its year: the times of the clock that are whole
// multiples of the step. Throws Error where it is no day, and where the sun does not rise.
std::vector<SunTime> sun_times(std::string const& text, SiteClock const& clock,
                               std::chrono::minutes step);

}  // namespace gpu_shading::energyplus
