#pragma once

#include <fmt/format.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <string>

namespace gpu_shading::energyplus {

// No coordinate is farther from the origin, m: single precision, in which EnergyPlus hands them
// over, is a metre there.
inline constexpr double farthest_coordinate = 1e7;

// False also where a coordinate is not a number.
inline bool is_within_reach(glm::dvec3 const& point) {
  return std::abs(point.x) <= farthest_coordinate && std::abs(point.y) <= farthest_coordinate &&
         std::abs(point.z) <= farthest_coordinate;
}

// What is wrong with a point that is not, after its name.
inline std::string describe_out_of_reach(glm::dvec3 const& point) {
  return fmt::format("is ({}, {}, {}) m, expected {} m at most from the origin", point.x, point.y,
                     point.z, farthest_coordinate);
}

}  // namespace gpu_shading::energyplus
