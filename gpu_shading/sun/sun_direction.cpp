#include "gpu_shading/sun_direction.h"

#include <cmath>
#include <numbers>

namespace gpu_shading {

glm::dvec3 to_vector(SunDirection direction) {
  double const level = std::cos(direction.altitude);
  return {level * std::sin(direction.azimuth), level * std::cos(direction.azimuth),
          std::sin(direction.altitude)};
}

SunDirection to_direction(glm::dvec3 const& towards_sun) {
  double const level = std::hypot(towards_sun.x, towards_sun.y);
  SunDirection direction;
  direction.altitude = std::atan2(towards_sun.z, level);
  // At the zenith, the horizontal part is only rounding error.
  constexpr double no_azimuth = 1e-14;
  if (level > no_azimuth * std::abs(towards_sun.z)) {
    direction.azimuth = std::atan2(towards_sun.x, towards_sun.y);
    if (direction.azimuth < 0.0) direction.azimuth += 2.0 * std::numbers::pi;
  }
  return direction;
}

}  // namespace gpu_shading
