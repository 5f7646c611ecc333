#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
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

}  // namespace gpu_shading
