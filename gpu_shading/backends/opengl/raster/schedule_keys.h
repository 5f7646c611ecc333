#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gpu_shading {

// Keys with which the pixels of one view record which scheduled shades the sun passed, and how
// often each schedule: every shade adds its schedule's key to the red, green and blue of a float
// target. A schedule takes as many bits of one channel as the number of its shades in the view
// needs, so that no sum carries over into the next; a float counts exactly up to 2^24.
class ScheduleKeys {
 public:
  static constexpr int digits_of_a_channel = 24;
  static constexpr int channels = 3;

  using Sum = std::array<std::uint32_t, channels>;

  // For shades with these schedules, one entry per shade; schedules from 0 to `schedules`
  // (exclusive). Empty if 72 bits are not enough.
  static std::optional<ScheduleKeys> make(std::span<int const> shades, int schedules);

  // The key of each schedule; 0 if it is not in the view.
  std::vector<glm::vec4> const& keys() const { return keys_; }

  // Schedules and how often each was passed, in the order of schedules.
  std::vector<std::pair<int, int>> powers(Sum const& sum) const;

 private:
  struct Slot {
    int schedule = 0;
    int digits = 0;
    std::size_t channel = 0;
    int shift = 0;
  };

  std::vector<Slot> slots_;
  std::vector<glm::vec4> keys_;
};

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
