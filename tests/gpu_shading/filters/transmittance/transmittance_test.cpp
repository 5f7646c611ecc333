#include "gpu_shading/transmittance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "support/degree.h"
#include "support/refusal.h"

namespace gpu_shading {
namespace {

double const nan = std::numeric_limits<double>::quiet_NaN();

TEST(Transmittance, IsOpaqueUnlessToldOtherwise) { EXPECT_EQ(Transmittance()(0.5), 0.0); }

TEST(Transmittance, TakesAnglesBeyondTheEndsAtTheEnds) {
  auto const tau = Transmittance::polynomial_in_degrees({0.9, -0.01});
  EXPECT_DOUBLE_EQ(tau(-1e-9), 0.9);
  EXPECT_NEAR(tau(90.0 * degree + 1e-9), 0.0, 1e-12);
}

TEST(Constant, IsItsValueAtEveryAngle) {
  auto const tau = Transmittance::constant(0.35);
  for (double const angle : {0.0, 45.0, 90.0}) EXPECT_EQ(tau(angle * degree), 0.35);
  EXPECT_EQ(refusal_of([] { Transmittance::constant(1.2); }),
            "transmittance is 1.2, expected 0 to 1");
  EXPECT_EQ(refusal_of([] { Transmittance::constant(nan); }),
            "transmittance is nan, expected 0 to 1");
}

TEST(Polynomial, RunsInDegreesOrInTheCosine) {
  auto const in_degrees = Transmittance::polynomial_in_degrees({0.8, 0.0, -1e-5, 0.0, -1e-9});
  EXPECT_NEAR(in_degrees(60.0 * degree), 0.8 - 1e-5 * 3600 - 1e-9 * 12960000, 1e-12);
  auto const in_cosine = Transmittance::polynomial_in_cosine({0.1, 0.2, 0.0, 0.4});
  EXPECT_NEAR(in_cosine(60.0 * degree), 0.1 + 0.2 / 2 + 0.4 / 8, 1e-12);
  EXPECT_NEAR(in_cosine(90.0 * degree), 0.1, 1e-12);
}

TEST(Polynomial, OutsideItsRangeNamesAngleAndValue) {
  EXPECT_EQ(refusal_of([] {
              Transmittance::polynomial_in_degrees({0.9, 0.01});
            }),
            "transmittance is 1.001 at 10.1 degrees, expected 0 to 1");
  EXPECT_EQ(refusal_of([] {
              Transmittance::polynomial_in_cosine({1.3, -1.0});
            }),
            "transmittance is 1.00095921 at 72.6 degrees, expected 0 to 1");
  EXPECT_EQ(refusal_of([] {
              Transmittance::polynomial_in_cosine({0.5, nan});
            }),
            "transmittance is nan at 0 degrees, expected 0 to 1");
}

TEST(Polynomial, MayTouchItsRangeWithinRounding) {
  auto const tau = Transmittance::polynomial_in_cosine({-5e-10, 1.0 + 1e-9});
  EXPECT_EQ(tau(0.0), 1.0);
  EXPECT_EQ(tau(90.0 * degree), 0.0);
}

TEST(Polynomial, HasADegreeOfEightAtMost) {
  EXPECT_EQ(refusal_of([] { Transmittance::polynomial_in_cosine(std::vector<double>(9, 0.1)); }),
            "accepted");
  EXPECT_EQ(refusal_of([] { Transmittance::polynomial_in_cosine(std::vector<double>(10, 0.1)); }),
            "polynomial has 10 coefficients, expected 1 to 9");
  EXPECT_EQ(refusal_of([] { Transmittance::polynomial_in_degrees({}); }),
            "polynomial has 0 coefficients, expected 1 to 9");
}

TEST(Table, GoesThroughItsPointsAndIsConstantBeyond) {
  for (std::size_t points = 2; points <= 5; ++points) {
    std::vector<double> angles{10.0, 30.0, 50.0, 70.0, 80.0};
    std::vector<double> values{0.8, 0.7, 0.75, 0.3, 0.1};
    angles.resize(points);
    values.resize(points);
    auto const tau = Transmittance::table(angles, values);
    for (std::size_t i = 0; i < points; ++i) {
      EXPECT_NEAR(tau(angles[i] * degree), values[i], 1e-14);
    }
    EXPECT_EQ(tau(0.0), 0.8);
    EXPECT_EQ(tau(90.0 * degree), values.back());
  }
}

TEST(Table, OfThreePointsIsStraightBetweenThem) {
  auto const tau = Transmittance::table({0.0, 60.0, 90.0}, {0.8, 0.6, 0.0});
  EXPECT_NEAR(tau(30.0 * degree), 0.7, 1e-14);
  EXPECT_NEAR(tau(75.0 * degree), 0.3, 1e-14);
}

TEST(Table, OfPointsOnALineIsThatLine) {
  auto const tau = Transmittance::table({0, 20, 30, 60, 90}, {0.9, 0.7, 0.6, 0.3, 0.0});
  for (int angle = 0; angle <= 90; ++angle) {
    EXPECT_NEAR(tau(angle * degree), 0.9 - 0.01 * angle, 1e-14);
  }
}

// What a cubic spline through the same points would not do.
TEST(Table, NeverLeavesTheRangeOfTheNeighbouringPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anything(0.0, 1.0);
  for (int round = 0; round < 200; ++round) {
    std::vector<double> angles;
    std::vector<double> values;
    double angle = 0.0;
    while (angle <= 90.0) {
      angles.push_back(angle);
      angle += 0.5 + 20.0 * anything(random);
      values.push_back(std::round(4.0 * anything(random)) / 4.0);
    }
    if (angles.size() < 2) continue;
    auto const tau = Transmittance::table(angles, values);
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      auto const [low, high] = std::minmax(values[i], values[i + 1]);
      double before = values[i];
      for (int step = 0; step <= 20; ++step) {
        double const now = tau(std::lerp(angles[i], angles[i + 1], step / 20.0) * degree);
        EXPECT_GE(now, low - 1e-12);
        EXPECT_LE(now, high + 1e-12);
        EXPECT_GE((now - before) * (values[i + 1] - values[i]), -1e-12);
        before = now;
      }
    }
  }
}

TEST(Table, NamesTheAngleThatIsWrong) {
  EXPECT_EQ(refusal_of([] {
              Transmittance::table({0, 40}, {0.9, 1.3});
            }),
            "transmittance is 1.3 at 40 degrees, expected 0 to 1");
  EXPECT_EQ(refusal_of([] {
              Transmittance::table({0, 95}, {0.9, 0.3});
            }),
            "angle is 95 degrees, expected 0 to 90");
  EXPECT_EQ(refusal_of([] {
              Transmittance::table({0, 40, 40}, {0.9, 0.3, 0.2});
            }),
            "angle of 40 degrees follows 40, expected increasing angles");
  EXPECT_EQ(refusal_of([] { Transmittance::table({0}, {0.9}); }),
            "table has 1 points, expected 2 or more");
  EXPECT_EQ(refusal_of([] {
              Transmittance::table({0, 90}, {0.9});
            }),
            "table has 2 angles and 1 transmittances, expected equal numbers");
}

TEST(Transmittance, NormalValueScalesTheCurve) {
  auto const curve = Transmittance::polynomial_in_cosine({0.1, 0.5});
  auto const scaled = Transmittance::with_normal(curve, 0.9);
  EXPECT_DOUBLE_EQ(scaled(0.0), 0.9);
  EXPECT_DOUBLE_EQ(scaled(1.0), 1.5 * curve(1.0));
  EXPECT_EQ(Transmittance::with_normal(curve, 0.0)(0.5), 0.0);
  EXPECT_THROW(Transmittance::with_normal(curve, 1.1), Error);
  EXPECT_THROW(Transmittance::with_normal(Transmittance(), 0.5), Error);
}

}  // namespace
}  // namespace gpu_shading
