#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace gpu_shading::energyplus {

// No coordinate is farther from the origin, m: single precision, in which EnergyPlus hands them
// over, is a metre there.
inline constexpr double farthest_coordinate = 1e7;

// False also where a coordinate is not a number.
inline bool is_within_reach(glm::dvec3 const& point) {
  return std::abs(point.x) <= farthest_coordinate && std::abs(point.y) <= farthest_coordinate &&
         std::abs(point.z) <= farthest_coordinate;
}

}  // namespace gpu_shading::energyplus
