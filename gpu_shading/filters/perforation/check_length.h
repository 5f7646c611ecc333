#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "gpu_shading/error.h"

namespace gpu_shading {

inline void check_positive(std::string_view field, double value) {
  // Written so that NaN fails.
  if (value > 0.0 && std::isfinite(value)) return;
  throw Error(fmt::format("{} is {:.9g} m, expected more than 0", field, value));
}

// For the sizes of holes and tiles: their squares and ratios neither overflow nor vanish.
inline void check_length(std::string_view field, double value) {
  constexpr double shortest = 1e-6;
  constexpr double longest = 1e5;
  if (value >= shortest && value <= longest) return;
  throw Error(
      fmt::format("{} is {:.9g} m, expected {:.9g} to {:.9g}", field, value, shortest, longest));
}

}  // namespace gpu_shading
