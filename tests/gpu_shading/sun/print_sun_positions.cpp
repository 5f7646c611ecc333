// Prints the sun's azimuth and altitude in degrees as sun_of_day has it, at the end of every time
// step of a year's 365 days, night left out: day, step, azimuth, altitude.
//
//   print_sun_positions LATITUDE LONGITUDE ZONE STEPS    degrees, degrees, hours, a day's time
//   steps

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "gpu_shading/sun_position.h"

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  constexpr double degree = std::numbers::pi / 180.0;
  double const latitude = std::atof(argv[1]) * degree;
  double const longitude = std::atof(argv[2]);
  double const meridian = 15.0 * std::atof(argv[3]);
  int const steps = std::atoi(argv[4]);
  for (int day = 1; day <= 365; ++day) {
    auto const of_day = gpu_shading::sun_of_day(day);
    for (int step = 1; step <= steps; ++step) {
      double const turn =
          360.0 * step / steps - 180.0 + longitude - meridian + of_day.equation_of_time / 4.0;
      auto const sun = gpu_shading::to_direction(
          gpu_shading::HourDirection{of_day.declination, turn * degree}, latitude);
      if (sun.altitude <= 0.0) continue;
      std::printf("%d %d %.6f %.6f\n", day, step, sun.azimuth / degree, sun.altitude / degree);
    }
  }
  return 0;
}
