#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
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

// The colour of a sunlit fraction, 0 .. 1, as red, green and blue, 0 .. 255: from dark blue for 0
// to yellow for 1. The colour map is cividis (Nunez, Anderton & Renslow 2018), which is legible
// with any kind of colour vision and in grey.
glm::dvec3 fraction_colour(double fraction);

}  // namespace gpu_shading
