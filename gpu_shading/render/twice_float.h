#pragma once

#include <glm/vec3.hpp>

namespace gpu_shading {

// A double as the sum of two floats, 48 bits: high the nearest float, low what that left.
struct TwiceFloat {
  glm::vec3 high;
  glm::vec3 low;

  explicit TwiceFloat(glm::dvec3 const& value) : high(value), low(value - glm::dvec3(high)) {}
};

static_assert(sizeof(TwiceFloat) == 6 * sizeof(float));

}  // namespace gpu_shading
