#include "session/answers.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

TEST(Answers, SameDirectionSameEntry) {
  Answers answers(3);
  SunDirection const noon{0.1, 0.9};
  EXPECT_FALSE(Answers::known(answers.at(noon, 0).projected_area[2]));
  answers.at(noon, 0).projected_area[2] = 1.5F;
  answers.at({0.2, 0.9}, 0).projected_area[2] = 2.5F;
  answers.at(noon, 1).projected_area[2] = 3.5F;
  EXPECT_EQ(answers.at(noon, 0).projected_area[2], 1.5F);
  EXPECT_EQ(answers.at(noon, 1).projected_area[2], 3.5F);
  EXPECT_EQ(answers.at(noon, 1).state, 1U);
}

TEST(Answers, MemoryIsBounded) {
  constexpr std::size_t surfaces = 1'000'000;
  Answers answers(surfaces);
  for (int i = 0; i < 300; ++i) answers.at({i * 0.001, 0.5}, 0);
  std::size_t bytes = 0;
  answers.for_each(
      [&](auto const& direction) { bytes += direction.projected_area.size() * sizeof(float); });
  EXPECT_LE(bytes, Answers::max_bytes);
  EXPECT_GT(bytes, 0U);
}

}  // namespace
}  // namespace gpu_shading::energyplus
