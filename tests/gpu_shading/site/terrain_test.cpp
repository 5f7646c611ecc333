#include "gpu_shading/terrain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gpu_shading {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// 3 x 2 nodes, 30 m apart, of zone 33's middle.
TerrainGrid slope() {
  TerrainGrid grid;
  grid.coordinates = MapCoordinates::parse("UTM 33N");
  grid.first = {500000.0, 5000000.0};
  grid.step_x = grid.step_y = 30.0;
  grid.columns = 3;
  grid.rows = 2;
  grid.elevations = {100, 110, 120, 130, 140, 150};
  return grid;
}

GeographicPoint at(TerrainGrid const& grid, double x, double y) {
  return grid.coordinates.to_geographic({x, y});
}

TEST(Terrain, BilinearBetweenNodes) {
  auto const grid = slope();
  EXPECT_NEAR(*elevation_at(grid, at(grid, 500000, 5000000)), 100.0, 1e-6);
  EXPECT_NEAR(*elevation_at(grid, at(grid, 500060, 5000030)), 150.0, 1e-6);
  // The plane 100 + x / 3 + y, which bilinear interpolation has exactly.
  EXPECT_NEAR(*elevation_at(grid, at(grid, 500048, 5000021)), 100 + 16 + 21, 1e-6);
  EXPECT_FALSE(elevation_at(grid, at(grid, 499999, 5000010)));
  EXPECT_FALSE(elevation_at(grid, at(grid, 500010, 5000031)));
}

TEST(Terrain, WhatHasNoDataIsNoGround) {
  auto grid = slope();
  grid.elevations[2] = none;
  EXPECT_TRUE(elevation_at(grid, at(grid, 500015, 5000015)));
  EXPECT_FALSE(elevation_at(grid, at(grid, 500045, 5000015)));
  LocalAxes const axes(at(grid, 500000, 5000000));
  auto const polygons = ground(grid, axes, 0.0);
  ASSERT_EQ(polygons.size(), 2U);
  EXPECT_EQ(polygons[0].outline.size(), 4U);
  EXPECT_EQ(polygons[1].outline.size(), 3U);
  grid.elevations[1] = none;
  EXPECT_EQ(ground(grid, axes, 0.0).size(), 1U);
}

TEST(Terrain, GroundIsTheSlope) {
  auto const grid = slope();
  auto origin = at(grid, 500000, 5000000);
  origin.elevation = 90.0;
  auto const polygons = ground(grid, LocalAxes(origin), 0.0);
  ASSERT_EQ(polygons.size(), 2U);
  auto const& ring = polygons[0].outline;
  EXPECT_NEAR(ring[0].z, 10.0, 1e-6);
  EXPECT_NEAR(ring[1].x, 30.0 / 0.9996, 0.01);
  EXPECT_NEAR(ring[2].z, 50.0, 1e-3);
  // z = x / 3 + y faces up.
  auto const facing = normal(polygons[0]);
  EXPECT_NEAR(facing.z, 1.0 / std::sqrt(1.0 + 1.0 + 1.0 / 9.0), 1e-3);
  EXPECT_LT(facing.x, 0.0);
  EXPECT_LT(facing.y, 0.0);
}

TEST(Terrain, ClearGroundIsLeftOut) {
  auto const grid = slope();
  LocalAxes const axes(at(grid, 500000, 5000015));
  EXPECT_EQ(ground(grid, axes, 20.0).size(), 1U);
  EXPECT_EQ(ground(grid, axes, 100.0).size(), 0U);
}

TEST(Terrain, AcrossTheAntimeridian) {
  TerrainGrid grid;
  grid.first = {179.999, -16.801};
  grid.step_x = grid.step_y = 0.001;
  grid.columns = grid.rows = 3;
  grid.elevations = {0, 1, 2, 0, 1, 2, 0, 1, 2};
  EXPECT_NEAR(*elevation_at(grid, {-16.8, -179.9995, 0.0}), 1.5, 1e-6);
  EXPECT_NEAR(*elevation_at(grid, {-16.8, 179.9995, 0.0}), 0.5, 1e-6);
  auto const polygons = ground(grid, LocalAxes({-16.8, 180.0, 0.0}), 0.0);
  ASSERT_EQ(polygons.size(), 4U);
  for (auto const& polygon : polygons) {
    for (auto const& node : polygon.outline) EXPECT_LT(std::abs(node.x), 110.0);
  }
}

}  // namespace
}  // namespace gpu_shading
