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

}  // namespace gpu_shading
