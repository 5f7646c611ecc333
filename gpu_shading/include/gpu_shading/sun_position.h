#pragma once

#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// The sun's position in equatorial coordinates; radians. At any latitude, the declination stays
// between the solstices', and the earth's rotation changes the hour angle alone.
struct HourDirection {
  double declination = 0.0;  // north of the equator positive
  double hour_angle = 0.0;   // from local noon towards the west, -pi .. pi
};

// Latitudes here and below are geographic, in radians, north positive, -pi/2 .. pi/2.
SunDirection to_direction(HourDirection direction, double latitude);
HourDirection to_hour_direction(SunDirection direction, double latitude);

// Hour angle at which the centre of the sun is on the horizon, without refraction: 0 .. pi; 0 in
// polar night, pi in polar day.
double sunset_hour_angle(double declination, double latitude);

// Quantities of the sun that depend on time but not on the location.
struct SunOfTime {
  double declination = 0.0;       // radians
  double equation_of_time = 0.0;  // apparent minus mean solar time, minutes
};

// EnergyPlus's values for a whole day, 1 .. 366: Fourier series in the day of the year, the same
// every year (Engineering Reference, "Sun Path Calculations"). At noon from 2017 to 2024 they are
// within 0.5 degrees and 0.7 minutes of NOAA's solar calculator, because leap years move the
// calendar relative to the sun. The declination is constant during the day.
SunOfTime sun_of_day(int day_of_year);

}  // namespace gpu_shading
