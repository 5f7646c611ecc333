#include "backends/opengl/raster/schedule_keys.h"

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <numeric>
#include <random>

namespace gpu_shading {
namespace {

using Powers = std::vector<std::pair<int, int>>;

TEST(ScheduleKeys, SumsSayHowOftenEachWasPassed) {
  std::mt19937 engine(7);
  for (int round = 0; round < 200; ++round) {
    int const schedules = 1 + static_cast<int>(engine() % 12U);
    std::vector<int> shades(40);
    for (int& shade : shades) {
      shade = static_cast<int>(engine() % static_cast<unsigned>(schedules));
    }
    auto const keys = ScheduleKeys::make(shades, schedules);
    ASSERT_TRUE(keys);
    // Any of the shades, each once.
    std::vector<int> passed(static_cast<std::size_t>(schedules), 0);
    glm::vec3 sum(0.0F);
    for (int const schedule : shades) {
      if (engine() % 3U == 0U) continue;
      sum += glm::vec3(keys->keys()[static_cast<std::size_t>(schedule)]);
      ++passed[static_cast<std::size_t>(schedule)];
    }
    Powers expected;
    for (int schedule = 0; schedule < schedules; ++schedule) {
      int const power = passed[static_cast<std::size_t>(schedule)];
      if (power > 0) expected.emplace_back(schedule, power);
    }
    EXPECT_EQ(keys->powers({static_cast<std::uint32_t>(sum.x), static_cast<std::uint32_t>(sum.y),
                            static_cast<std::uint32_t>(sum.z)}),
              expected);
  }
}

TEST(ScheduleKeys, SeventyTwoDigitsAreAsManyAsThereAre) {
  std::vector<int> shades(72);
  std::iota(shades.begin(), shades.end(), 0);
  EXPECT_TRUE(ScheduleKeys::make(shades, 72));
  shades.push_back(72);
  EXPECT_FALSE(ScheduleKeys::make(shades, 73));
  // A view needs digits for what is in it alone.
  EXPECT_TRUE(ScheduleKeys::make(std::vector<int>{500, 2, 500}, 1000));
  // 500 shades take 9 digits; two such schedules fit each channel.
  std::vector<int> panes;
  for (int schedule = 0; schedule < 6; ++schedule) {
    panes.insert(panes.end(), 500, schedule);
  }
  EXPECT_TRUE(ScheduleKeys::make(panes, 7));
  panes.insert(panes.end(), 500, 6);
  EXPECT_FALSE(ScheduleKeys::make(panes, 7));
}

}  // namespace
}  // namespace gpu_shading
