#pragma once

#include <cstddef>
#include <vector>

#include "gpu_shading/sun_position.h"

namespace gpu_shading {

// Obliquity of the ecliptic, a little rounded up: no declination is beyond it. Radians.
constexpr double most_declination = 0.409454;  // 23.46 degrees

// At most `most` directions above the horizon, about evenly spread between the solstices: on arcs
// of equal declination, at equal steps of hour angle from sunrise to sunset, on every other arc
// half a step on (but for its ends).
std::vector<HourDirection> spread_on_arcs(double latitude, std::size_t most);

// Directions of the paper's grid: every 14th day of a year of sun_of_day, from its first, at
// multiples of an azimuth step (radians) from noon.
struct AzimuthDay {
  int day = 0;
  int first = 0;  // multiple of the step, of the first direction; east is negative in the north
  std::vector<HourDirection> directions;  // at consecutive multiples
};
std::vector<AzimuthDay> sample_azimuths(double latitude, double step);

// The azimuth from noon that the paper's grid counts by, -pi .. pi: from the south, clockwise; in
// the southern hemisphere from the north, anticlockwise.
double azimuth_from_noon(SunDirection direction, double latitude);

}  // namespace gpu_shading
