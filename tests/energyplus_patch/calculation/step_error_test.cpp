#include "calculation/step_error.h"

#include <gtest/gtest.h>

namespace gpu_shading::energyplus {
namespace {

std::vector<MovingShade> stepped_louvres() {
  MovingShade shade;
  shade.maximum = 88.0;
  shade.step = 5.0;
  return {shade};
}

// Of two receivers: a hundredth a degree, and half as much.
std::vector<double> fractions_of_position(SunDirection /*sun*/,
                                          std::vector<double> const& positions) {
  return {positions[0] / 100.0, positions[0] / 200.0};
}

TEST(StepError, IsThatOfTheReceiverMostAffected) {
  auto const shades = stepped_louvres();
  StepError error(shades);
  error.note({}, {10.0}, {12.0});
  error.note({}, {10.0}, {9.0});
  error.note({}, {10.0}, {10.0});  // exact
  error.note({}, {85.0}, {86.0});  // the last step is shorter
  auto const found = error.estimate(fractions_of_position);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->timesteps, 3U);
  EXPECT_NEAR(found->most, 0.02, 1e-12);
  EXPECT_NEAR(found->mean, (0.02 + 0.01 + 0.01) / 3.0, 1e-12);
}

TEST(StepError, IsNoneWithoutRounding) {
  auto const shades = stepped_louvres();
  StepError error(shades);
  error.note({}, {10.0}, {10.0});
  EXPECT_FALSE(error.estimate(fractions_of_position));
}

TEST(StepError, AsksAtFewTimestepsSpreadOverARun) {
  auto const shades = stepped_louvres();
  StepError error(shades);
  for (int i = 0; i < 1000; ++i) error.note({i * 1e-3, 0.5}, {10.0}, {12.0});
  double last = -1.0;
  int asked = 0;
  auto const found = error.estimate([&](SunDirection sun, auto const& positions) {
    last = sun.azimuth;
    ++asked;
    return fractions_of_position(sun, positions);
  });
  ASSERT_TRUE(found);
  EXPECT_GE(found->timesteps, 15U);
  EXPECT_LE(found->timesteps, 32U);
  EXPECT_EQ(asked, 2 * static_cast<int>(found->timesteps));
  EXPECT_GT(last, 0.9);
}

}  // namespace
}  // namespace gpu_shading::energyplus
