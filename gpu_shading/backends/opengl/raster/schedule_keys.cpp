#include "backends/opengl/raster/schedule_keys.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/type_ptr.hpp>

namespace gpu_shading {

std::optional<ScheduleKeys> ScheduleKeys::make(std::span<int const> shades, int schedules) {
  std::vector<unsigned> counts(static_cast<std::size_t>(schedules), 0U);
  for (int const schedule : shades) ++counts[static_cast<std::size_t>(schedule)];

  ScheduleKeys made;
  for (int schedule = 0; schedule < schedules; ++schedule) {
    unsigned const count = counts[static_cast<std::size_t>(schedule)];
    if (count > 0) made.slots_.push_back({schedule, static_cast<int>(std::bit_width(count)), 0, 0});
  }
  // Placing the widest first leaves the fewest gaps.
  std::stable_sort(made.slots_.begin(), made.slots_.end(),
                   [](Slot const& a, Slot const& b) { return a.digits > b.digits; });
  made.keys_.resize(static_cast<std::size_t>(schedules), glm::vec4(0.0F));
  std::array<int, channels> used{};
  for (Slot& slot : made.slots_) {
    auto const room = std::find_if(used.begin(), used.end(), [&](int digits) {
      return digits + slot.digits <= digits_of_a_channel;
    });
    if (room == used.end()) return std::nullopt;
    slot.channel = static_cast<std::size_t>(room - used.begin());
    slot.shift = *room;
    *room += slot.digits;
    glm::vec4& key = made.keys_[static_cast<std::size_t>(slot.schedule)];
    glm::value_ptr(key)[slot.channel] = static_cast<float>(1U << static_cast<unsigned>(slot.shift));
  }
  std::sort(made.slots_.begin(), made.slots_.end(),
            [](Slot const& a, Slot const& b) { return a.schedule < b.schedule; });
  return made;
}

std::vector<std::pair<int, int>> ScheduleKeys::powers(Sum const& sum) const {
  std::vector<std::pair<int, int>> found;
  for (Slot const& slot : slots_) {
    std::uint32_t const mask = (1U << static_cast<unsigned>(slot.digits)) - 1U;
    std::uint32_t const passed = (sum[slot.channel] >> static_cast<unsigned>(slot.shift)) & mask;
    if (passed > 0) found.emplace_back(slot.schedule, static_cast<int>(passed));
  }
  return found;
}

}  // namespace gpu_shading
