#pragma once

#include <string_view>

namespace gpu_shading {

// Sets of instructions that kernels are compiled for, each including those before it. Results are
// the same to the bit.
enum class Instructions {
  baseline,  // of any processor of the architecture
  sse4,      // SSE4.2 and POPCNT
  avx2,      // AVX2 and FMA
};

// The largest set that this processor has, or the environment variable GPU_SHADING_INSTRUCTIONS
// (baseline, sse4 or avx2) if it names a smaller one. Throws Error if the variable has another
// value.
Instructions instructions();

std::string_view name(Instructions set);  // "AVX2"

// A kernel, compiled for each set of instructions. It must be an inline function with the attribute
// gnu::always_inline, and so must all that it should vectorise through.
template <auto kernel>
struct Compiled;

template <typename Result, typename... Arguments, Result (*kernel)(Arguments...)>
struct Compiled<kernel> {
  static Result baseline(Arguments... arguments) { return kernel(arguments...); }
#ifdef __x86_64__
  [[gnu::target("sse4.2,popcnt")]] static Result sse4(Arguments... arguments) {
    return kernel(arguments...);
  }
  [[gnu::target("avx2,fma,popcnt")]] static Result avx2(Arguments... arguments) {
    return kernel(arguments...);
  }
#endif
};

// Calls a kernel as compiled for instructions().
template <auto kernel, typename... Arguments>
auto run(Arguments&&... arguments) {
#ifdef __x86_64__
  using All = Compiled<kernel>;
  static auto* const fastest = instructions() == Instructions::avx2   ? &All::avx2
                               : instructions() == Instructions::sse4 ? &All::sse4
                                                                      : &All::baseline;
  return fastest(arguments...);
#else
  return kernel(arguments...);
#endif
}

}  // namespace gpu_shading
