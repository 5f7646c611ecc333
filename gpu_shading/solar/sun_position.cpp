#include "gpu_shading/sun_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

namespace gpu_shading {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double minutes_of_day = 1440.0;

// c[0] + c[1] sin x + c[2] cos x + c[3] sin 2x + c[4] cos 2x + ...
double fourier(std::array<double, 9> const& c, double x) {
  double sum = c[0];
  double angle = x;
  for (std::size_t i = 1; i < c.size(); i += 2, angle += x) {
    sum += c[i] * std::sin(angle) + c[i + 1] * std::cos(angle);
  }
  return sum;
}

double wrap(double angle) { return std::remainder(angle, 2.0 * pi); }

}  // namespace

SunDirection to_direction(HourDirection direction, double latitude) {
  double const level = std::cos(direction.declination);
  double const up = std::sin(direction.declination);
  double const towards_noon = level * std::cos(direction.hour_angle);
  return to_direction(glm::dvec3(-level * std::sin(direction.hour_angle),
                                 std::cos(latitude) * up - std::sin(latitude) * towards_noon,
                                 std::sin(latitude) * up + std::cos(latitude) * towards_noon));
}

HourDirection to_hour_direction(SunDirection direction, double latitude) {
  auto const sun = to_vector(direction);
  double const up = std::sin(latitude) * sun.z + std::cos(latitude) * sun.y;
  double const towards_noon = std::cos(latitude) * sun.z - std::sin(latitude) * sun.y;
  return {std::atan2(up, std::hypot(sun.x, towards_noon)), std::atan2(-sun.x, towards_noon)};
}

double sunset_hour_angle(double declination, double latitude) {
  // Without tangents, which are infinite at the poles.
  double const up = -std::sin(latitude) * std::sin(declination);
  double const level = std::cos(latitude) * std::cos(declination);
  if (up >= level) return 0.0;
  return up <= -level ? pi : std::acos(up / level);
}

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

SunOfTime sun_of_day(int day_of_year) {
  constexpr std::array<double, 9> sine_of_declination{0.00561800,  0.0657911,   -0.392779,
                                                      0.00064440,  -0.00618495, -0.00010101,
                                                      -0.00007951, -0.00011691, 0.00002096};
  constexpr std::array<double, 9> hours{0.00021971,  -0.122649,   0.00762856,
                                        -0.156308,   -0.0530028,  -0.00388702,
                                        -0.00123978, -0.00270502, -0.00167992};
  double const angle = 2.0 * pi / 366.0 * day_of_year;
  return {std::asin(fourier(sine_of_declination, angle)), 60.0 * fourier(hours, angle)};
}

}  // namespace gpu_shading
