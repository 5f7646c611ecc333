#pragma once

#include <fmt/format.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <string>

namespace gpu_shading::energyplus {

// Limit of coordinates, m: there, the single precision of the vertices that EnergyPlus passes is a
// metre.
inline constexpr double farthest_coordinate = 1e7;

// False for coordinates that are not numbers.
inline bool is_within_reach(glm::dvec3 const& point) {
  return std::abs(point.x) <= farthest_coordinate && std::abs(point.y) <= farthest_coordinate &&
         std::abs(point.z) <= farthest_coordinate;
}

// The error for a point that is not, to follow its name.
inline std::string describe_out_of_reach(glm::dvec3 const& point) {
  return fmt::format("is ({}, {}, {}) m, expected {} m at most from the origin", point.x, point.y,
                     point.z, farthest_coordinate);
}

}  // namespace gpu_shading::energyplus
