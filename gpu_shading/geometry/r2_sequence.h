#pragma once

#include <glm/vec2.hpp>

namespace gpu_shading {

// The reciprocal of the plastic number and its square. The fractional parts of their multiples fill
// a square evenly, for any number of them (the R2 sequence, Roberts 2018).
inline constexpr glm::dvec2 r2_step{0.7548776662466927, 0.5698402909980532};

}  // namespace gpu_shading
