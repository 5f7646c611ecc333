#include "sun/sampling/radial_spline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "gpu_shading/sun_direction.h"
#include "sun/sampling/sunlit_splines.h"

namespace gpu_shading {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<glm::dvec3> places(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-2.0, 2.0);
  std::vector<glm::dvec3> made;
  for (std::size_t i = 0; i < count; ++i) {
    double const x = within(random);
    double const y = within(random);
    made.emplace_back(x, y, within(random));
  }
  return made;
}

MatrixXd values_at(std::vector<glm::dvec3> const& nodes) {
  MatrixXd values(static_cast<Index>(nodes.size()), 2);
  for (Index i = 0; i < values.rows(); ++i) {
    auto const& node = nodes[static_cast<std::size_t>(i)];
    values.row(i) << std::sin(node.x) * node.y + node.z, 0.7;
  }
  return values;
}

constexpr std::array<RadialKernel, 2> kernels{RadialKernel::rough, RadialKernel::smooth};

TEST(RadialSpline, GoesThroughItsNodesAndKeepsConstants) {
  for (auto const kernel : kernels) {
    for (std::size_t const count : {1U, 2U, 40U}) {
      auto const nodes = places(count);
      auto const values = values_at(nodes);
      auto const fitted = RadialSpline(kernel, nodes).fit(values);
      for (Index i = 0; i < values.rows(); ++i) {
        EXPECT_NEAR(fitted.at(nodes[static_cast<std::size_t>(i)])(0), values(i, 0), 1e-10);
      }
      EXPECT_NEAR(fitted.at({9.0, -5.0, 1.0})(1), 0.7, 1e-9);
    }
  }
}

double linear(glm::dvec3 const& at) { return 0.2 + 0.3 * at.x - 0.1 * at.y + 0.4 * at.z; }

MatrixXd linear_at(std::vector<glm::dvec3> const& nodes) {
  MatrixXd values(static_cast<Index>(nodes.size()), 1);
  for (Index i = 0; i < values.rows(); ++i) {
    values(i, 0) = linear(nodes[static_cast<std::size_t>(i)]);
  }
  return values;
}

TEST(RadialSpline, ContinuesLinearFunctionsIfSmooth) {
  auto nodes = places(40);
  glm::dvec3 const beyond{9.0, -5.0, 1.0};
  EXPECT_NEAR(RadialSpline(RadialKernel::smooth, nodes).fit(linear_at(nodes)).at(beyond)(0),
              linear(beyond), 1e-9);
  for (auto& node : nodes) node.z = 0.0;
  glm::dvec3 const beside{9.0, -5.0, 0.0};
  EXPECT_NEAR(RadialSpline(RadialKernel::smooth, nodes).fit(linear_at(nodes)).at(beside)(0),
              linear(beside), 1e-9);
}

TEST(RadialSpline, IsRoughWhereNodesDetermineNoLinearFunction) {
  // As many nodes as it takes, but on one circle, as the sun's directions of one day are.
  std::vector<glm::dvec3> nodes(20);
  double angle = 0.0;
  for (auto& node : nodes) {
    node = {0.5, std::sin(angle), std::cos(angle)};
    angle += 0.1;
  }
  auto const values = linear_at(nodes);
  auto const smooth = RadialSpline(RadialKernel::smooth, nodes).fit(values);
  auto const rough = RadialSpline(RadialKernel::rough, nodes).fit(values);
  for (glm::dvec3 const& place : {glm::dvec3(0.5, 1.0, 2.0), glm::dvec3(-1.0, 0.0, 0.5)}) {
    EXPECT_EQ(smooth.at(place)(0), rough.at(place)(0));
  }
}

TEST(RadialSpline, KeepsKinksWhereFractionsReachTheirLimits) {
  // The shadow of an edge that crosses a receiver as the sun moves.
  auto const fraction = [](double x, double y) {
    return std::clamp(0.5 + 0.6 * x + 0.2 * y, 0.0, 1.0);
  };
  std::vector<glm::dvec3> nodes;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) nodes.emplace_back(0.5 * i + (j % 2) * 0.25, 0.5 * j, 0.0);
  }
  MatrixXd values(static_cast<Index>(nodes.size()), 1);
  for (Index i = 0; i < values.rows(); ++i) {
    auto const& node = nodes[static_cast<std::size_t>(i)];
    values(i, 0) = fraction(node.x, node.y);
  }
  RadialSpline const spline(RadialKernel::rough, nodes);
  MatrixXd const released = spline.release_limits(values);
  auto const mean_error = [&](MatrixXd const& through) {
    auto const fitted = spline.fit(through);
    double sum = 0.0;
    int count = 0;
    for (double x = -1.9; x < 1.9; x += 0.07) {
      for (double y = -1.9; y < 1.9; y += 0.07) {
        double const got = std::clamp(fitted.at({x, y, 0.0})(0), 0.0, 1.0);
        sum += std::abs(got - fraction(x, y));
        ++count;
      }
    }
    return sum / count;
  };
  EXPECT_LT(mean_error(released), 0.6 * mean_error(values));
  for (Index i = 0; i < values.rows(); ++i) {
    EXPECT_NEAR(std::clamp(released(i, 0), 0.0, 1.0), values(i, 0), 1e-12);
    if (values(i, 0) > 0.0 && values(i, 0) < 1.0) {
      EXPECT_EQ(released(i, 0), values(i, 0));
    }
  }
}

TEST(RadialSpline, SaysWhatItWouldMissWithoutANode) {
  for (auto const kernel : kernels) {
    for (std::size_t const count : {2U, 40U}) {
      auto const nodes = places(count);
      auto const values = values_at(nodes);
      MatrixXd const misses = RadialSpline(kernel, nodes).leave_one_out(values);
      for (std::size_t i = 0; i < count; ++i) {
        auto others = nodes;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        double const got = RadialSpline(kernel, others).fit(values_at(others)).at(nodes[i])(0);
        auto const row = static_cast<Index>(i);
        EXPECT_NEAR(misses(row, 0), values(row, 0) - got, 1e-9);
      }
    }
  }
}

TEST(ShadowFall, IsWhereTheRayThroughAPointMeetsThePlane) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  // Facing south, sun in the south-east: the shadow falls to the west and down.
  double const altitude = 35 * degree;
  glm::dvec2 const fall = shadow_fall({0, -1, 0}, to_vector(SunDirection{150 * degree, altitude}));
  EXPECT_NEAR(std::abs(std::sinh(fall.x)), std::tan(30 * degree), 1e-12);
  EXPECT_NEAR(std::abs(std::sinh(fall.y)), std::tan(altitude) / std::cos(30 * degree), 1e-12);
  // A roof's shadows point away from the sun, as long as its altitude tells.
  glm::dvec2 const flat = shadow_fall({0, 0, 1}, to_vector(SunDirection{210 * degree, altitude}));
  EXPECT_NEAR(std::hypot(std::sinh(flat.x), std::sinh(flat.y)), 1.0 / std::tan(altitude), 1e-12);
  EXPECT_NEAR(std::abs(std::sinh(flat.x) / std::sinh(flat.y)), std::tan(30 * degree), 1e-12);
  // In the plane, and behind it, there is an answer all the same.
  glm::dvec2 const behind = shadow_fall({0, -1, 0}, to_vector(SunDirection{1.0, 0.2}));
  EXPECT_TRUE(std::isfinite(behind.x) && std::isfinite(behind.y));
}

}  // namespace
}  // namespace gpu_shading
