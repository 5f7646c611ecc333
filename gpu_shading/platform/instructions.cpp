#include "platform/instructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

constexpr char const* variable = "GPU_SHADING_INSTRUCTIONS";

Instructions of_processor() {
#ifdef __x86_64__
  bool const has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  bool const has_sse4 =
      __builtin_cpu_supports("sse4.2") != 0 && __builtin_cpu_supports("popcnt") != 0;
  if (has_avx2 && has_sse4) return Instructions::avx2;
  if (has_sse4) return Instructions::sse4;
#endif
  return Instructions::baseline;
}

Instructions at_most() {
  char const* const given = std::getenv(variable);
  if (given == nullptr || *given == '\0') return Instructions::avx2;
  constexpr std::array<std::pair<std::string_view, Instructions>, 3> sets{
      {{"baseline", Instructions::baseline},
       {"sse4", Instructions::sse4},
       {"avx2", Instructions::avx2}}};
  for (auto const& [word, set] : sets) {
    if (word == given) return set;
  }
  throw Error(fmt::format("{} is '{}': expected 'baseline', 'sse4' or 'avx2'", variable, given));
}

}  // namespace

Instructions instructions() {
  static Instructions const used = std::min(of_processor(), at_most());
  return used;
}

std::string_view name(Instructions set) {
  switch (set) {
    case Instructions::avx2:
      return "AVX2";
    case Instructions::sse4:
      return "SSE4.2";
    case Instructions::baseline:
      break;
  }
  return "baseline instructions";
}

}  // namespace gpu_shading
