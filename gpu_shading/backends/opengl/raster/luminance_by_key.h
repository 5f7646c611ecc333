#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <map>

#include "backends/opengl/raster/schedule_keys.h"

namespace gpu_shading {

// Luminance by the keys of the schedules passed, in order, summed over pixels in double precision,
// with one entry per combination.
using LuminanceByKey = std::map<ScheduleKeys::Sum, double>;

// Adds pixels: red, green and blue hold the keys, and alpha the luminance. Neighbouring pixels
// mostly have the same key, so it is only looked up when it changes.
class LuminanceSorter {
 public:
  explicit LuminanceSorter(LuminanceByKey& sums) : sums_(&sums) {}

  void add(glm::vec4 const& pixel) {
    if (pixel.a == 0.0F) return;
    if (sum_ == nullptr || pixel.r != last_.r || pixel.g != last_.g || pixel.b != last_.b) {
      sum_ = &(*sums_)[{static_cast<std::uint32_t>(pixel.r), static_cast<std::uint32_t>(pixel.g),
                        static_cast<std::uint32_t>(pixel.b)}];
      last_ = pixel;
    }
    *sum_ += static_cast<double>(pixel.a);
  }

 private:
  LuminanceByKey* sums_;
  glm::vec4 last_{0.0F};
  double* sum_ = nullptr;
};

}  // namespace gpu_shading
