#pragma once

#include <cstddef>

namespace gpu_shading {

// Consecutive elements of an array.
struct Range {
  std::size_t first = 0;
  std::size_t count = 0;
};

}  // namespace gpu_shading
