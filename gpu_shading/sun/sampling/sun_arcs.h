#pragma once

#include <cstddef>
#include <vector>

#include "gpu_shading/sun_position.h"

namespace gpu_shading {

// Obliquity of the ecliptic, slightly rounded up, so that no declination exceeds it. Radians.
constexpr double max_declination = 0.409454;  // 23.46 degrees

// At most `max_count` directions above the horizon, spread about evenly between the solstices: on
// arcs of equal declination, at equal steps of the hour angle from sunrise to sunset, with every
// other arc offset by half a step (except at its ends).
std::vector<HourDirection> spread_on_arcs(double latitude, std::size_t max_count);

// The directions of the paper's grid: every 14th day of a year of sun_of_day, from the first day,
// at multiples of an azimuth step (radians) from noon.
struct AzimuthDay {
  int day = 0;
  int first = 0;  // first direction as a multiple of the step; east is negative in the north
  std::vector<HourDirection> directions;  // at consecutive multiples
};
std::vector<AzimuthDay> sample_azimuths(double latitude, double step);

// The azimuth from noon that the paper's grid uses, -pi .. pi: from the south, clockwise; in the
// southern hemisphere from the north, anticlockwise.
double azimuth_from_noon(SunDirection direction, double latitude);

}  // namespace gpu_shading
