#pragma once

namespace gpu_shading {

// The nearest whole number, of one below 2^51: what adding and taking away leaves. Unlike
// std::round, it is no call on older processors, and compilers take several at a time.
inline double nearest_whole(double x) {
  constexpr double rounding = 0x1.8p52;
  return (x + rounding) - rounding;
}

}  // namespace gpu_shading
