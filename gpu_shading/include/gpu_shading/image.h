#pragma once

#include <cstdint>
#include <vector>

namespace gpu_shading {

// An 8-bit image: rows from the top, each from the left, `channels` values per pixel: red, green
// and blue, 0 .. 255.
struct Image {
  int width = 0;  // pixels
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;  // width x height x channels
};

}  // namespace gpu_shading
