#pragma once

namespace gpu_shading {

// In metres: 5 * mm.
inline constexpr double mm = 1e-3;

}  // namespace gpu_shading
