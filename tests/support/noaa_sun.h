#pragma once

#include <chrono>

#include "gpu_shading/sun_position.h"

namespace gpu_shading {

// By NOAA's solar calculator (gml.noaa.gov/grad/solcalc), after Meeus, Astronomical Algorithms
// (1998), chapters 25 and 28: within 0.01 degrees from 1900 to 2100. Leap years are those of the
// calendar.
SunOfTime sun_at(std::chrono::sys_seconds universal_time);

// The same as seen from a location, with longitude in radians, east positive; without refraction
// and parallax, as in EnergyPlus. Clock time is universal time plus the offset of the time zone,
// plus an hour during daylight saving time.
SunDirection sun_position(std::chrono::sys_seconds universal_time, double latitude,
                          double longitude);

}  // namespace gpu_shading
