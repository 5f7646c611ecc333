// Cells of a receiver: areas, axes and sample points, by hand.

#include "reports/map_grid.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numeric>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// A wall 4 m wide and 3 m high that faces south, with its lower left corner at (1, 2, 0).
Polygon wall() { return {{{1, 2, 0}, {5, 2, 0}, {5, 2, 3}, {1, 2, 3}}, {}}; }

double area_of_cells(MapGrid const& grid) {
  return std::accumulate(grid.cells().begin(), grid.cells().end(), 0.0,
                         [](double sum, MapCell const& cell) { return sum + cell.area; });
}

void expect_near(glm::dvec3 const& a, glm::dvec3 const& b) {
  EXPECT_LT(glm::distance(a, b), 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(MapGridTest, AWallIsSeenFromOutside) {
  MapGrid const grid(wall(), 1.0);
  expect_near(grid.axes().u, {1, 0, 0});
  expect_near(grid.axes().v, {0, 0, 1});
  expect_near(grid.axes().origin, {1, 2, 0});
  EXPECT_EQ(grid.columns(), 4);
  EXPECT_EQ(grid.rows(), 3);
  ASSERT_EQ(grid.cells().size(), 12U);
  EXPECT_EQ(grid.cells()[5].column, 1);
  EXPECT_EQ(grid.cells()[5].row, 1);
  expect_near(grid.axes().place(grid.cells()[5].centre), {2.5, 2, 1.5});
}

TEST(MapGridTest, AWallToTheNorthHasEastOnItsLeft) {
  MapGrid const grid({{{5, 2, 0}, {1, 2, 0}, {1, 2, 3}, {5, 2, 3}}, {}}, 1.0);
  expect_near(grid.axes().u, {-1, 0, 0});
  expect_near(grid.axes().origin, {5, 2, 0});
}

TEST(MapGridTest, AHorizontalReceiverHasNorthUp) {
  MapGrid const roof({{{0, 0, 3}, {6, 0, 3}, {6, 2, 3}, {0, 2, 3}}, {}}, 1.0);
  expect_near(roof.axes().u, {1, 0, 0});
  expect_near(roof.axes().v, {0, 1, 0});
  MapGrid const soffit({{{0, 2, 3}, {6, 2, 3}, {6, 0, 3}, {0, 0, 3}}, {}}, 1.0);
  expect_near(soffit.axes().u, {-1, 0, 0});  // from below
  expect_near(soffit.axes().v, {0, 1, 0});
}

TEST(MapGridTest, CellsFitAndAreNoLargerThanTheSpacing) {
  MapGrid const grid(wall(), 0.7);
  EXPECT_EQ(grid.columns(), 6);
  EXPECT_EQ(grid.rows(), 5);
  EXPECT_DOUBLE_EQ(grid.cell_size().x, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(grid.cell_size().y, 0.6);
}

TEST(MapGridTest, CellsAreCutAtOpeningsAndEdges) {
  auto polygon = wall();
  polygon.holes.push_back({{1.5, 2, 0.5}, {3.25, 2, 0.5}, {3.25, 2, 2.0}, {1.5, 2, 2.0}});
  MapGrid const grid(polygon, 1.0);
  EXPECT_NEAR(area_of_cells(grid), 12.0 - 1.75 * 1.5, 1e-9);
  EXPECT_EQ(grid.cells().size(), 11U);  // one lies in the opening
  EXPECT_NEAR(grid.cells()[0].area, 0.75, 1e-9);
  for (auto const& cell : grid.cells()) {
    for (std::size_t i = 0; i < 200; ++i) {
      auto const point = grid.point(cell, i);
      EXPECT_FALSE(point.x > 1.5 && point.x < 3.25 && point.z > 0.5 && point.z < 2.0);
    }
  }
}

TEST(MapGridTest, ReceiversNeedNotBeConvex) {
  // An L of 3 x 3 m less 2 x 2 m.
  MapGrid const grid({{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, {}}, 0.8);
  EXPECT_NEAR(area_of_cells(grid), 5.0, 1e-9);
}

TEST(MapGridTest, TheMeanOfSamplePointsIsTheCentre) {
  MapGrid const grid(wall(), 1.0);
  glm::dvec3 sum{0.0};
  constexpr int points = 1000;
  for (std::size_t i = 0; i < points; ++i) sum += grid.point(grid.cells()[0], i);
  EXPECT_LT(glm::distance(sum / double{points}, {1.5, 2, 0.5}), 1e-3);
}

TEST(MapGridTest, TooManyCellsAreRefused) { EXPECT_THROW(MapGrid(wall(), 0.001), Error); }

}  // namespace
}  // namespace gpu_shading::energyplus
