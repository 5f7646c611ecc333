// What a point in front of a wall sees of the sky, by hand. The wall faces south.

#include "reports/sky_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>

namespace gpu_shading::energyplus {
namespace {

constexpr double far = 1e4;
constexpr glm::dvec3 south{0.0, -1.0, 0.0};

Polygon ledge(double height, double depth) {
  return {{{-far, 0, height}, {far, 0, height}, {far, -depth, height}, {-far, -depth, height}}, {}};
}

Polygon street_wall(double height, double distance) {
  return {{{-far, -distance, -far},
           {far, -distance, -far},
           {far, -distance, height},
           {-far, -distance, height}},
          {}};
}

Polygon fin(double beside, double depth) {
  return {{{beside, 0, -far}, {beside, -depth, -far}, {beside, -depth, far}, {beside, 0, far}}, {}};
}

struct Shade {
  Polygon polygon;
  ShadeKind kind;
  BeamFilter filter = {};
};

struct Street {
  explicit Street(std::vector<Shade> const& casters) {
    for (auto const& [polygon, kind, filter] : casters) {
      scene.add({"caster", polygon, Casting::always, filter});
      kinds.push_back(kind);
    }
  }

  Scene scene;
  std::vector<ShadeKind> kinds;
};

std::vector<BeamShare> sky_behind(std::vector<Shade> const& casters, SkyGrid const& grid,
                                  glm::dvec3 const& normal = south) {
  Street const street(casters);
  return trace_shares(RayScene(street.scene), {}, street.kinds, point_at({0, 0, 0}, normal),
                      grid.directions());
}

std::vector<double> horizon_behind(std::vector<Shade> const& casters, SkyGrid const& grid) {
  Street const street(casters);
  RayScene const rays(street.scene);
  auto const point = point_at({0, 0, 0}, south);
  auto const sky = trace_shares(rays, {}, street.kinds, point, grid.directions());
  return trace_horizon(rays, {}, street.kinds, point, grid, sky);
}

// Checks that what is in front of the wall is sunlit, or stopped by one kind, as a closed form
// says.
void expect_sky(std::vector<BeamShare> const& sky, SkyGrid const& grid, ShadeKind kind,
                bool (*is_lit)(double towards, double right, double up)) {
  auto const directions = grid.directions();
  int lit = 0;
  int shaded = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    auto const ray = to_vector(directions[i]);
    ASSERT_EQ(sky[i].faced, ray.y < 0.0);
    if (!sky[i].faced) continue;
    bool const expected = is_lit(-ray.y, ray.x, ray.z);
    (expected ? lit : shaded) += 1;
    EXPECT_EQ(sky[i].sunlit, expected ? 1.0F : 0.0F)
        << glm::degrees(directions[i].azimuth) << ' ' << glm::degrees(directions[i].altitude);
    EXPECT_EQ(sky[i].stopped.at(static_cast<std::size_t>(kind)), expected ? 0.0F : 1.0F);
  }
  EXPECT_GT(lit, 100);
  EXPECT_GT(shaded, 100);
}

TEST(SkyMask, AnOverhangCutsOffAtItsProfileAngle) {
  SkyGrid const grid(2);
  expect_sky(sky_behind({{ledge(1.7, 1.3), ShadeKind::shades}}, grid), grid, ShadeKind::shades,
             [](double towards, double, double up) { return up / towards < 1.7 / 1.3; });
}

TEST(SkyMask, AWallAcrossTheStreetIsTheHorizon) {
  SkyGrid const grid(2);
  constexpr double height = 12.0;
  constexpr double distance = 9.3;
  auto const sky = sky_behind({{street_wall(height, distance), ShadeKind::neighbours}}, grid);
  expect_sky(sky, grid, ShadeKind::neighbours,
             [](double towards, double, double up) { return up / towards > height / distance; });
  auto const heights =
      horizon_behind({{street_wall(height, distance), ShadeKind::neighbours}}, grid);
  ASSERT_EQ(heights.size(), grid.columns());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    double const from_south = (static_cast<double>(i) + 0.5) * grid.step() - 180.0;
    double const expected = glm::degrees(
        std::atan(height / distance * std::max(std::cos(glm::radians(from_south)), 0.0)));
    EXPECT_NEAR(heights[i], expected, 0.01) << from_south;
  }
  // An infinite strip in front of a vertical surface leaves (1 - sin(beta)) / 2 of the sky.
  double const beta = std::atan(height / distance);
  auto const view = sky_view(grid, sky, south);
  EXPECT_NEAR(view.view, (1.0 - std::sin(beta)) / 2.0, 0.002);
  EXPECT_NEAR(view.view + view.stopped.at(static_cast<std::size_t>(ShadeKind::neighbours)), 0.5,
              1e-6);
}

TEST(SkyMask, AHorizonEndsAtTheZenithAndAtTheLevel) {
  SkyGrid const grid(10);
  // A low wall under the first directions of the grid, and one above the zenith's.
  for (auto const height : horizon_behind({{street_wall(0.4, 9.3), ShadeKind::shades}}, grid)) {
    EXPECT_LE(height, glm::degrees(std::atan(0.4 / 9.3)) + 0.01);
  }
  auto const heights = horizon_behind({{street_wall(0.4, 9.3), ShadeKind::shades}}, grid);
  EXPECT_NEAR(heights[grid.columns() / 2],
              glm::degrees(std::atan(0.4 / 9.3 * std::cos(glm::radians(5.0)))), 0.01);
  EXPECT_EQ(heights.front(), 0.0);
  auto const all = horizon_behind(
      {{ledge(1.0, far), ShadeKind::shades}, {street_wall(far, 1.0), ShadeKind::neighbours}}, grid);
  EXPECT_NEAR(all[grid.columns() / 2], 90.0, 0.05);
}

TEST(SkyMask, AFinShadesItsSide) {
  SkyGrid const grid(2);
  expect_sky(sky_behind({{fin(0.6, 0.83), ShadeKind::building}}, grid), grid, ShadeKind::building,
             [](double towards, double right, double) { return right / towards < 0.6 / 0.83; });
}

TEST(SkyMask, WithoutShadesTheViewFactorIsThatOfTheTilt) {
  SkyGrid const grid(5);
  for (double const tilt : {0.0, 30.0, 90.0, 135.0}) {
    glm::dvec3 const normal(0.0, -std::sin(glm::radians(tilt)), std::cos(glm::radians(tilt)));
    auto const view = sky_view(grid, sky_behind({}, grid, normal), normal);
    EXPECT_NEAR(view.unshaded, (1.0 + normal.z) / 2.0, 1e-12);
    EXPECT_NEAR(view.view, view.unshaded, 1e-6) << tilt;
  }
}

TEST(SkyMask, WhatIsInFrontOfAnotherStopsItsPartFirst) {
  SkyGrid const grid(10);
  BeamFilter glass;
  glass.set(
      AngularTransmittance{std::make_shared<Transmittance const>(Transmittance::constant(0.25))});
  auto const sky = sky_behind({{street_wall(far, 5.0), ShadeKind::terrain},
                               {street_wall(far, 2.0), ShadeKind::geometry, glass}},
                              grid);
  auto const& ahead = sky[grid.columns() / 2];  // to the south, low
  EXPECT_FLOAT_EQ(ahead.sunlit, 0.0F);
  EXPECT_FLOAT_EQ(ahead.stopped.at(static_cast<std::size_t>(ShadeKind::geometry)), 0.75F);
  EXPECT_FLOAT_EQ(ahead.stopped.at(static_cast<std::size_t>(ShadeKind::terrain)), 0.25F);
}

TEST(SkyMask, PointsOfAReceiverAreOnIt) {
  Polygon const window{{{1, 2, 0}, {5, 2, 0}, {5, 2, 1}, {1, 2, 1}}, {}};
  auto const points = points_of(window, 16);
  EXPECT_EQ(points.points.size(), 16U);
  double share = 0.0;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    share += points.shares[i];
    for (auto const& point : points.points[i]) {
      EXPECT_TRUE(point.x > 1 && point.x < 5 && point.y == 2 && point.z > 0 && point.z < 1);
    }
  }
  EXPECT_NEAR(share, 1.0, 1e-12);
}

}  // namespace
}  // namespace gpu_shading::energyplus
