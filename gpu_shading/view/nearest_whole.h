#pragma once

#include <cstdint>

namespace gpu_shading {

// Avoids a call, which std::round is on older processors.
inline std::int64_t nearest_whole(double x) {
  return static_cast<std::int64_t>(x + (x < 0.0 ? -0.5 : 0.5));
}

}  // namespace gpu_shading
