#pragma once

#include <glm/vec3.hpp>

namespace gpu_shading {

// A sun direction: azimuth clockwise from true north, altitude from the horizon; radians. Defaults
// to the zenith.
struct SunDirection {
  double azimuth = 0.0;
  double altitude = 1.57079632679489661923;

  bool operator==(SunDirection const&) const = default;
};

// The unit vector from the site to the sun; x east, y north, z up.
glm::dvec3 to_vector(SunDirection direction);

// The inverse of to_vector(); the vector need not have unit length. The zenith has azimuth 0.
SunDirection to_direction(glm::dvec3 const& towards_sun);

}  // namespace gpu_shading
