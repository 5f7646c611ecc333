#pragma once

namespace gpu_shading {

#ifdef __x86_64__
// Includes fused multiply-add, which came with it.
inline bool has_avx2() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
}
#endif

}  // namespace gpu_shading
