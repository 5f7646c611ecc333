#pragma once

#include <glm/vec3.hpp>

namespace gpu_shading {

// A double as the sum of two floats with 48 bits: high is the nearest float, low the remainder.
struct SplitDouble {
  glm::vec3 high;
  glm::vec3 low;

  explicit SplitDouble(glm::dvec3 const& value) : high(value), low(value - glm::dvec3(high)) {}
};

static_assert(sizeof(SplitDouble) == 6 * sizeof(float));

}  // namespace gpu_shading
