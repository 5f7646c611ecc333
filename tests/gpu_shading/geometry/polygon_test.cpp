#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "gpu_shading/scene.h"

namespace gpu_shading {
namespace {

Ring const square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

TEST(Area, OfARectangleIsWidthTimesHeight) {
  EXPECT_DOUBLE_EQ(area({{{0, 0, 0}, {3, 0, 0}, {3, 0, 2}, {0, 0, 2}}, {}}), 6.0);
}

TEST(Area, OfATiltedTriangleIsHalfTheCrossProduct) {
  EXPECT_NEAR(area({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}}), std::sqrt(3.0) / 2.0, 1e-15);
}

TEST(Area, OfANonConvexOutlineLeavesTheNotchOut) {
  // An L: 2 x 2 less 1 x 1.
  Ring const l{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  EXPECT_DOUBLE_EQ(area({l, {}}), 3.0);
}

TEST(Area, IsLessItsHolesWhicheverWayTheyRun) {
  Ring const hole{{0.5, 0.5, 0}, {1.5, 0.5, 0}, {1.5, 1.5, 0}, {0.5, 1.5, 0}};
  Ring const reversed(hole.rbegin(), hole.rend());
  EXPECT_DOUBLE_EQ(area({square, {hole}}), 3.0);
  EXPECT_DOUBLE_EQ(area({square, {reversed}}), 3.0);
}

TEST(Area, OfDegeneratePolygonsIsZero) {
  EXPECT_EQ(area({}), 0.0);
  EXPECT_EQ(area({{{1, 2, 3}}, {}}), 0.0);
  EXPECT_EQ(area({{{0, 0, 0}, {1, 0, 0}}, {}}), 0.0);
  EXPECT_EQ(area({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {}}), 0.0);
  EXPECT_EQ(area({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {}}), 0.0);
  double const nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(area({{{0, 0, 0}, {1, 0, 0}, {1, nan, 0}}, {}}), 0.0);
}

TEST(Area, KeepsItsDigitsAtSiteCoordinates) {
  Ring moved = square;
  for (auto& vertex : moved) vertex += glm::dvec3(5e5, 5e6, 300.0);
  EXPECT_NEAR(area({moved, {}}), 4.0, 1e-8);
}

TEST(Normal, PointsWhereTheOutlineRunsCounterClockwise) {
  glm::dvec3 const up = normal({square, {}});
  EXPECT_NEAR(glm::distance(up, glm::dvec3(0, 0, 1)), 0.0, 1e-15);
  EXPECT_NEAR(glm::distance(normal({{square.rbegin(), square.rend()}, {}}), -up), 0.0, 1e-15);
}

TEST(Normal, IsUnitAlsoForANotQuitePlanarPolygon) {
  Ring bent = square;
  bent[2].z = 0.05;
  glm::dvec3 const n = normal({bent, {}});
  EXPECT_NEAR(glm::length(n), 1.0, 1e-15);
  EXPECT_GT(n.z, 0.99);
}

TEST(Normal, IsZeroForADegeneratePolygon) {
  EXPECT_EQ(normal({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {}}), glm::dvec3(0.0));
}

TEST(Scene, NoSurfaceShadesItselfWhateverTheRuleSays) {
  Scene scene;
  SurfaceId const a = scene.add({"a", {square, {}}});
  SurfaceId const b = scene.add({"b", {square, {}}});
  EXPECT_EQ(a, 0U);
  EXPECT_EQ(b, 1U);
  scene.set_rule({{{0, 0}, {0, 0}}, 1, {1}});
  EXPECT_FALSE(scene.may_shade(a, a));
  EXPECT_TRUE(scene.may_shade(a, b));
}

}  // namespace
}  // namespace gpu_shading
