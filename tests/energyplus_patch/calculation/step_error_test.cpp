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

// Of two receivers: the square of a hundredth a degree, and half as much. Between steps of 5
// degrees, a parabola is below its chords by 1e-4 * share * (1 - share) * 25.
std::vector<double> fractions_of_position(SunDirection /*sun*/,
                                          std::vector<double> const& positions) {
  double const share = positions[0] / 100.0;
  return {share * share, share * share / 2.0};
}

void note(StepError& error, double azimuth, double stood, double exact) {
  error.note({azimuth, 0.5}, around(stepped_louvres(), {stood}, {exact}), {exact});
}

TEST(StepError, IsThatOfTheReceiverMostAffected) {
  StepError error;
  note(error, 0.0, 10.0, 12.0);
  note(error, 0.0, 10.0, 9.0);
  note(error, 0.0, 10.0, 10.0);  // exact
  note(error, 0.0, 85.0, 86.0);  // the last step is shorter
  auto const found = error.estimate(fractions_of_position);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->timesteps, 3U);
  EXPECT_NEAR(found->most, 6e-4, 1e-12);
  EXPECT_NEAR(found->mean, (6e-4 + 4e-4 + 2e-4) / 3.0, 1e-12);
}

TEST(StepError, IsNoneAtSteps) {
  StepError error;
  note(error, 0.0, 10.0, 10.0);
  EXPECT_FALSE(error.estimate(fractions_of_position));
}

TEST(StepError, AsksAtFewTimestepsSpreadOverARun) {
  StepError error;
  for (int i = 0; i < 1000; ++i) note(error, i * 1e-3, 10.0, 12.0);
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
  EXPECT_EQ(asked, 3 * static_cast<int>(found->timesteps));
  EXPECT_GT(last, 0.9);
}

TEST(WeightedPositions, InterpolateALinearFunctionOfManyShadesExactly) {
  auto shades = stepped_louvres();
  shades.resize(4, shades.front());
  // Above, below, on the grid, and at the end of the range.
  std::vector<double> const exact{11.0, 58.5, 20.0, 87.0};
  auto const corners = around(shades, {10.0, 60.0, 20.0, 88.0}, exact);
  ASSERT_EQ(corners.size(), 4U);
  std::vector<double> sum(exact.size(), 0.0);
  double weights = 0.0;
  for (auto const& [positions, weight] : corners) {
    EXPECT_GT(weight, 0.0);
    weights += weight;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += weight * positions[i];
      EXPECT_EQ(positions[i], shades[i].nearest(positions[i]));
    }
  }
  EXPECT_NEAR(weights, 1.0, 1e-12);
  for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_NEAR(sum[i], exact[i], 1e-12);
}

}  // namespace
}  // namespace gpu_shading::energyplus
