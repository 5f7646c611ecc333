#include "gpu_shading/sun_position.h"

#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

namespace gpu_shading {
namespace {

using std::numbers::pi;

// c[0] + c[1] sin x + c[2] cos x + c[3] sin 2x + c[4] cos 2x + ...
double fourier(std::array<double, 9> const& c, double x) {
  double sum = c[0];
  double angle = x;
  for (std::size_t i = 1; i < c.size(); i += 2, angle += x) {
    sum += c[i] * std::sin(angle) + c[i + 1] * std::cos(angle);
  }
  return sum;
}

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
