#include "support/noaa_sun.h"

#include <cmath>
#include <numbers>

#include "support/degree.h"

namespace gpu_shading {
namespace {

using std::numbers::pi;
constexpr double minutes_of_day = 1440.0;

double wrap(double angle) { return std::remainder(angle, 2.0 * pi); }

}  // namespace

SunOfTime sun_at(std::chrono::sys_seconds universal_time) {
  using Days = std::chrono::duration<double, std::ratio<86400>>;
  using std::chrono::January;
  // From 2000-01-01 12:00.
  auto const epoch = std::chrono::sys_days{std::chrono::year{2000} / January / 1};
  double const days = Days(universal_time - epoch).count() - 0.5;
  double const t = days / 36525.0;
  double const mean_longitude = degree * (280.46646 + t * (36000.76983 + t * 0.0003032));
  double const anomaly = degree * (357.52911 + t * (35999.05029 - t * 0.0001537));
  double const eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  double const centre = degree * (std::sin(anomaly) * (1.914602 - t * (0.004817 + t * 0.000014)) +
                                  std::sin(2.0 * anomaly) * (0.019993 - t * 0.000101) +
                                  std::sin(3.0 * anomaly) * 0.000289);
  double const node = degree * (125.04 - 1934.136 * t);
  double const longitude = mean_longitude + centre - degree * (0.00569 + 0.00478 * std::sin(node));
  double const seconds = 21.448 - t * (46.815 + t * (0.00059 - t * 0.001813));
  double const obliquity =
      degree * (23.0 + (26.0 + seconds / 60.0) / 60.0 + 0.00256 * std::cos(node));
  double const y = std::pow(std::tan(obliquity / 2.0), 2);
  double const e = eccentricity;
  double const equation = y * std::sin(2.0 * mean_longitude) - 2.0 * e * std::sin(anomaly) +
                          4.0 * e * y * std::sin(anomaly) * std::cos(2.0 * mean_longitude) -
                          0.5 * y * y * std::sin(4.0 * mean_longitude) -
                          1.25 * e * e * std::sin(2.0 * anomaly);
  return {std::asin(std::sin(obliquity) * std::sin(longitude)),
          equation * minutes_of_day / (2.0 * pi)};
}

SunDirection sun_position(std::chrono::sys_seconds universal_time, double latitude,
                          double longitude) {
  using Minutes = std::chrono::duration<double, std::ratio<60>>;
  auto const midnight = std::chrono::floor<std::chrono::days>(universal_time);
  auto const sun = sun_at(universal_time);
  double const minutes = Minutes(universal_time - midnight).count() + sun.equation_of_time;
  double const turn = 2.0 * pi * minutes / minutes_of_day;
  return to_direction(HourDirection{sun.declination, wrap(turn + longitude - pi)}, latitude);
}

}  // namespace gpu_shading
