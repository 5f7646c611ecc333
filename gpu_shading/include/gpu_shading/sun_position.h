#pragma once

#include <chrono>

#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// Where the sun stands against the equator; radians. Whatever the latitude, it keeps to
// declinations between the solstices', and the earth's turn runs through the hour angle alone.
struct HourDirection {
  double declination = 0.0;  // from the equator to the north
  double hour_angle = 0.0;   // from local noon to the west, -pi .. pi
};

// Geographic latitude in radians, north positive, -pi/2 .. pi/2, here and below.
SunDirection to_direction(HourDirection direction, double latitude);
HourDirection to_hour_direction(SunDirection direction, double latitude);

// Hour angle at which the middle of the sun stands on the horizon, without refraction: 0 .. pi; 0
// in polar night, pi in polar day.
double sunset_hour_angle(double declination, double latitude);

// The sun at a time, for every place alike.
struct SunOfTime {
  double declination = 0.0;       // radians
  double equation_of_time = 0.0;  // apparent less mean solar time, minutes
};

// NOAA's solar calculator (gml.noaa.gov/grad/solcalc), after Meeus, Astronomical Algorithms (1998),
// chapters 25 and 28: within 0.01 degrees from 1900 to 2100. Leap years are the calendar's.
SunOfTime sun_at(std::chrono::sys_seconds universal_time);

// The same as seen from a place, longitude in radians, east positive: without refraction and
// parallax, as EnergyPlus has it. Clock time is universal time plus the zone's offset, plus an hour
// where daylight saving is in force.
SunDirection sun_position(std::chrono::sys_seconds universal_time, double latitude,
                          double longitude);

// As EnergyPlus has it for all of a day, 1 .. 366: Fourier series in the day of the year, the same
// every year (Engineering Reference, "Sun Path Calculations"). At noons of 2017 to 2024 within 0.5
// degrees and 0.7 minutes of sun_at: leap years move the calendar against the sun. The declination
// stands still during the day.
SunOfTime sun_of_day(int day_of_year);

}  // namespace gpu_shading
