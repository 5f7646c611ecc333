#include "backends/opengl/raster/split_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace gpu_shading {
namespace {

TEST(SplitDouble, HoldsFortyEightBitsOfEveryCoordinate) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> metres(-30000.0, 30000.0);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 1000; ++i) {
    double const x = metres(random);
    double const y = metres(random);
    points.emplace_back(x, y, metres(random));
  }
  std::vector<SplitDouble> halves;
  halves.reserve(points.size());
  for (auto const& point : points) halves.emplace_back(point);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      double const value = points[i][axis];
      float const high = halves[i].high[axis];
      EXPECT_LE(std::abs(value - double{high}), std::ldexp(std::abs(value), -24));
      EXPECT_LE(std::abs(value - (double{high} + double{halves[i].low[axis]})),
                std::ldexp(std::abs(value), -48))
          << "axis " << axis;
    }
  }
}

}  // namespace
}  // namespace gpu_shading
