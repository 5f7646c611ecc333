#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

namespace gpu_shading::energyplus {

// What Penumbra's matrix says: it looks from the sun at a surface's bounding rectangle, in parallel
// projection.
struct MatrixView {
  glm::dvec3 towards_sun;  // unit vector
  double width = 0.0;      // of what fills the viewport, m
  double height = 0.0;

  // From a matrix as OpenGL has it, by columns. Empty if it is not one of a parallel projection.
  static std::optional<MatrixView> of(std::array<float, 16> const& matrix);
};

}  // namespace gpu_shading::energyplus
