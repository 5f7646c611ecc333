#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "gpu_shading/renderer.h"

namespace gpu_shading {

// A question: the sunlit area of a receiver at one sun direction, or of the surfaces behind a
// window.
struct Question {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
  bool through = false;  // the receiver is a window, and these surfaces are wanted:
  std::span<SurfaceId const> interiors;
  std::span<Sunlit>
      answers;  // the receiver's answer, or one for each of `interiors`; zero when asked
};

}  // namespace gpu_shading
