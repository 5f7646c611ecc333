#include "backends/cpu/replicates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gpu_shading {
namespace {

using Lit = std::function<double(double height)>;

// A receiver of one unit of height, of which each row is lit by a function of its height.
RowSums rows_of(TileGrid const& grid, Lit const& lit) {
  RowSums sums;
  sums.lit.emplace_back();
  for (int row = 0; row < grid.mask_rows(); ++row) {
    double const height = (row + 0.5 - grid.shift.y) / grid.rows;
    double const own = height > 0.0 && height < 1.0 ? grid.width : 0.0;
    sums.own.push_back(own);
    sums.lit.front().push_back(own * lit(height));
  }
  return sums;
}

struct Measured {
  double fraction = 0.0;
  double uncertainty = 0.0;
};

Measured measured(double max_error, Lit const& lit) {
  Replicates replicates(max_error, 30.0, 100);
  do {
    EXPECT_TRUE(replicates.add(rows_of(replicates.grid(), lit)));
  } while (!replicates.done());
  return {replicates.means().front().unscheduled, replicates.uncertainty()};
}

// Also where rounding is all that they differ by.
TEST(Replicates, OfEqualRowsAreExact) {
  for (int i = 1; i < 200; ++i) {
    double const share = i / 200.0;
    Measured const found = measured(1e-3, [&](double) { return share; });
    EXPECT_NEAR(found.fraction, share, 1e-14);
    EXPECT_LT(found.uncertainty, 1e-12);
  }
}

// A shadow's edge along the rows, at any height.
TEST(Replicates, StateTheErrorOfAnEdgeAlongTheRows) {
  constexpr int views = 500;
  constexpr double target = 1e-3;
  int understated = 0;
  int beyond = 0;
  for (int i = 0; i < views; ++i) {
    double const edge = 0.1 + 0.8 * (i + 0.5) / views;
    Measured const found =
        measured(target, [&](double height) { return height < edge ? 1.0 : 0.0; });
    double const error = std::abs(found.fraction - edge);
    understated += error > found.uncertainty ? 1 : 0;
    beyond += error > target ? 1 : 0;
    EXPECT_LE(found.uncertainty, target);
  }
  EXPECT_LE(understated, views / 50);
  EXPECT_LE(beyond, views / 100);
}

// What repeats at any distance, also in step with the rows: then estimates from single rows say
// nothing.
TEST(Replicates, FindWhatIsInStepWithTheRows) {
  constexpr double target = 1e-2;
  int beyond = 0;
  int views = 0;
  for (double repeats = 20.0; repeats < 200.0; repeats += 0.5, ++views) {
    auto const lit = [&](double height) {
      return height * repeats - std::floor(height * repeats) < 0.3 ? 1.0 : 0.0;
    };
    double const whole = std::floor(repeats);
    double const exact = (whole * 0.3 + std::min(repeats - whole, 0.3)) / repeats;
    beyond += std::abs(measured(target, lit).fraction - exact) > target ? 1 : 0;
  }
  EXPECT_LE(beyond, views / 50);
}

TEST(Replicates, TakeMoreRowsUntilTheyMeetTheReceiver) {
  Replicates replicates(1e-3, 30.0, 100);
  int const rows = replicates.grid().rows;
  RowSums const missed{{0.0, 0.0}, {{0.0, 0.0}}, {}};
  EXPECT_TRUE(replicates.add(missed));
  EXPECT_FALSE(replicates.done());
  EXPECT_EQ(replicates.grid().rows, 2 * rows);
  int tries = 1;
  while (replicates.add(missed)) ++tries;
  EXPECT_LT(tries, 12);
}

}  // namespace
}  // namespace gpu_shading
