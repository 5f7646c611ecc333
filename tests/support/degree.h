#pragma once

#include <numbers>

namespace gpu_shading {

// In radians: 60 * degree.
inline constexpr double degree = std::numbers::pi / 180.0;

}  // namespace gpu_shading
