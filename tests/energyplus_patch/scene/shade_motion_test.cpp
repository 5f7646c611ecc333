#include "scene/shade_motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

using Motion = MovingShade::Motion;
using Axis = MovingShade::Axis;

// 4 x 1 m, level, its long edges east-west.
Polygon const slat{{{0, 0, 2}, {4, 0, 2}, {4, 1, 2}, {0, 1, 2}}, {}};

MovingShade shade_of(Motion motion, Axis axis = Axis::centre_line, glm::dvec3 direction = {}) {
  MovingShade shade;
  shade.motion = motion;
  shade.axis = axis;
  shade.direction = direction;
  return shade;
}

void expect_near(glm::dvec3 const& point, glm::dvec3 const& expected) {
  EXPECT_LT(glm::distance(point, expected), 1e-12)
      << point.x << ' ' << point.y << ' ' << point.z << " not " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

TEST(ShadeMotion, RotatesAboutTheCentreLineAndLowersTheSouthernEdge) {
  auto const turned = moved(slat, shade_of(Motion::rotate), 90.0);
  expect_near(turned.outline[0], {0, 0.5, 1.5});
  expect_near(turned.outline[2], {4, 0.5, 2.5});
}

TEST(ShadeMotion, OrderOfVerticesDoesNotChangeTheAxis) {
  auto reversed = slat;
  std::reverse(reversed.outline.begin(), reversed.outline.end());
  auto const turned = moved(reversed, shade_of(Motion::rotate), 90.0);
  expect_near(turned.outline[3], {0, 0.5, 1.5});
}

TEST(ShadeMotion, RotatesAboutTheEdgeInADirection) {
  auto const turned = moved(slat, shade_of(Motion::rotate, Axis::edge, {0, 1, 0}), 90.0);
  expect_near(turned.outline[0], {0, 1, 1});
  expect_near(turned.outline[3], {0, 1, 2});
}

TEST(ShadeMotion, SquaresTurnAboutALevelAxis) {
  Polygon const square{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {}};
  auto const axis = rotation_axis(square, shade_of(Motion::rotate));
  expect_near(axis.direction, {1, 0, 0});
  expect_near(axis.point, {0.5, 0, 0.5});
}

TEST(ShadeMotion, SlidesAndExtendsAlongADirection) {
  auto const slid = moved(slat, shade_of(Motion::slide, Axis::centre_line, {0, 0, -1}), 0.5);
  expect_near(slid.outline[2], {4, 1, 1.5});
  auto const grown = moved(slat, shade_of(Motion::extend, Axis::centre_line, {0, -1, 0}), 0.25);
  expect_near(grown.outline[0], {0, 0.75, 2});
  expect_near(grown.outline[2], {4, 1, 2});
  EXPECT_EQ(area(moved(slat, shade_of(Motion::extend, Axis::centre_line, {0, -1, 0}), 0.0)), 0.0);
}

// Four panels in a plane that faces south, along the east.
std::vector<Polygon> panels() {
  std::vector<Polygon> all;
  for (double x = 1.0; x < 5.0; ++x) {
    all.push_back({{{x, 2, 0}, {x + 1, 2, 0}, {x + 1, 2, 3}, {x, 2, 3}}, {}});
  }
  return all;
}

TEST(ShadeMotion, FoldsPairsOfPanelsFromTheEdgeThatStays) {
  auto shade = shade_of(Motion::fold, Axis::centre_line, {1, 0, 0});
  auto const drawn = panels();
  shade.track = fold_track(drawn, shade);
  double const c = std::cos(std::numbers::pi / 3);
  double const s = std::sin(std::numbers::pi / 3);
  double at = 1.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    auto const panel = moved(drawn[i], shade, 60.0);
    // Hinges move out to the south.
    double const from = i % 2 == 0 ? 2.0 : 2.0 - s;
    double const to = i % 2 == 0 ? 2.0 - s : 2.0;
    expect_near(panel.outline[0], {at, from, 0});
    expect_near(panel.outline[2], {at + c, to, 3});
    EXPECT_NEAR(area(panel), 3.0, 1e-12);
    at += c;
  }
  expect_near(moved(drawn[3], shade, 90.0).outline[1], {1, 2, 0});
  expect_near(moved(drawn[1], shade, -90.0).outline[0], {1, 3, 0});
  EXPECT_EQ(moved(drawn[2], shade, 0.0).outline, drawn[2].outline);
}

TEST(ShadeMotion, FoldsTowardsEitherEndAndInRowsAboveEachOther) {
  auto shade = shade_of(Motion::fold, Axis::centre_line, {-1, 0, 0});
  auto drawn = panels();
  for (auto above : panels()) {
    for (auto& point : above.outline) point.z += 3.0;
    drawn.push_back(above);
  }
  shade.track = fold_track(drawn, shade);
  EXPECT_EQ(shade.track.starts.size(), 4U);
  expect_near(moved(drawn[3], shade, 90.0).outline[1], {5, 2, 0});
  expect_near(moved(drawn[7], shade, 90.0).outline[0], {5, 1, 3});
}

TEST(ShadeMotion, OnlyEqualPairsFold) {
  auto const shade = shade_of(Motion::fold, Axis::centre_line, {1, 0, 0});
  auto three = panels();
  three.pop_back();
  EXPECT_THROW(fold_track(three, shade), Error);
  auto narrow = panels();
  narrow[3].outline[1].x = narrow[3].outline[2].x = 4.5;
  EXPECT_THROW(fold_track(narrow, shade), Error);
  EXPECT_THROW(fold_track(panels(), shade_of(Motion::fold, Axis::centre_line, {0, 1, 0})), Error);
  EXPECT_THROW(fold_track({}, shade), Error);
}

TEST(ShadeMotion, FacesTheProfileAngleOfTheSun) {
  // In the south-east: the profile angle of the slat is atan(tan(altitude) / cos(45 degrees)).
  glm::dvec3 const sun = glm::normalize(glm::dvec3(1, -1, 1));
  auto const shade = shade_of(Motion::rotate);
  double const position = facing_position(slat, shade, sun);
  EXPECT_NEAR(position, 45.0, 1e-9);
  auto const facing = normal(moved(slat, shade, position));
  EXPECT_NEAR(glm::dot(facing, sun), std::numbers::sqrt2 / std::numbers::sqrt3, 1e-12);
}

TEST(ShadeMotion, OnlyParallelSurfacesTrackTheSunTogether) {
  auto const surface = [](std::string name, Polygon polygon) {
    Surface made;
    made.name = std::move(name);
    made.polygon = std::move(polygon);
    return made;
  };
  auto const shade = shade_of(Motion::rotate);
  auto higher = slat;
  for (auto& point : higher.outline) point.z += 1.0;
  auto facing_down = slat;
  std::ranges::reverse(facing_down.outline);
  EXPECT_NO_THROW(expect_parallel(
      {surface("A", slat), surface("B", higher), surface("C", facing_down)}, shade));
  // About its own axis, and about another one.
  auto const tilted = moved(slat, shade, 20.0);
  auto turned = slat;
  for (auto& point : turned.outline) point = {-point.y, point.x, point.z};
  for (auto const& turn : {std::pair(tilted, "20"), {turned, "90"}}) {
    std::string const degrees = turn.second;
    EXPECT_THAT(
        [&] {
          expect_parallel({surface("A", slat), surface("B", turn.first)}, shade);
        },
        testing::ThrowsMessage<Error>(testing::HasSubstr("B is at " + degrees + " degrees to A")));
  }
}

TEST(ShadeMotion, PositionsAreOnTheGridAndAtItsEnds) {
  MovingShade shade;
  shade.minimum = 0.0;
  shade.maximum = 1.0;
  shade.step = 0.3;
  EXPECT_EQ(shade.positions().size(), 5U);
  EXPECT_DOUBLE_EQ(shade.nearest(0.31), 0.3);
  EXPECT_DOUBLE_EQ(shade.nearest(0.96), 1.0);
  EXPECT_DOUBLE_EQ(shade.nearest(0.94), 0.9);
  EXPECT_DOUBLE_EQ(shade.nearest(-5.0), 0.0);
  EXPECT_DOUBLE_EQ(shade.nearest(7.0), 1.0);
}

}  // namespace
}  // namespace gpu_shading::energyplus
