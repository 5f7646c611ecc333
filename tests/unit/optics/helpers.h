#pragma once

#include <string>

#include "gpu_shading/error.h"

namespace gpu_shading {

// What `make` complains of, empty where it does not.
template <typename Function>
std::string error_of(Function const& make) {
  try {
    make();
  } catch (Error const& error) {
    return error.what();
  }
  return {};
}

constexpr double degrees(double angle) { return angle * (3.14159265358979323846 / 180.0); }

}  // namespace gpu_shading
