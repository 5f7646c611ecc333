// Modules and cells on a surface, by hand.

#include "reports/module_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// A wall 4 m wide and 3 m high that faces south.
Polygon wall() { return {{{1, 2, 0}, {5, 2, 0}, {5, 2, 3}, {1, 2, 3}}, {}}; }

PvModules modules_of(double width, double length) {
  PvModules modules;
  modules.where = "GPUShading:PVModules M";
  modules.width = width;
  modules.length = length;
  modules.cell_columns = 6;
  modules.cell_rows = 10;
  modules.diodes = 3;
  return modules;
}

void expect_box(FlatBox const& box, glm::dvec2 const& low, glm::dvec2 const& high) {
  EXPECT_LT(glm::distance(box.low, low), 1e-9) << box.low.x << ' ' << box.low.y;
  EXPECT_LT(glm::distance(box.high, high), 1e-9) << box.high.x << ' ' << box.high.y;
}

TEST(ModuleLayout, FillsASurfaceFromItsMiddle) {
  auto spec = modules_of(0.9, 1.4);
  spec.gap = 0.1;
  spec.string_length = 3;
  ModuleLayout const layout(spec, "WALL", wall());
  ASSERT_EQ(layout.modules().size(), 8U);
  expect_box(layout.modules()[0].box, {0.05, 0.05}, {0.95, 1.45});
  expect_box(layout.modules()[5].box, {1.05, 1.55}, {1.95, 2.95});
  EXPECT_EQ(layout.strings(), 3);
  EXPECT_EQ(layout.modules()[2].string, 0);
  EXPECT_EQ(layout.modules()[3].string, 1);
  auto const polygon = layout.polygon(layout.modules()[5].box);
  EXPECT_LT(glm::distance(polygon.outline[0], {2.05, 2.0 - ray_lift, 1.55}), 1e-9);
  EXPECT_LT(glm::distance(normal(polygon), {0, -1, 0}), 1e-9);
}

TEST(ModuleLayout, StringsMayRunAlongColumns) {
  auto spec = modules_of(1.0, 1.5);
  spec.direction = PvModules::Direction::columns;
  ModuleLayout const layout(spec, "WALL", wall());
  ASSERT_EQ(layout.modules().size(), 8U);
  EXPECT_EQ(layout.modules()[1].column, 0);
  EXPECT_EQ(layout.modules()[1].row, 1);
}

TEST(ModuleLayout, CellsLieInsideTheFrame) {
  auto spec = modules_of(1.0, 1.5);
  spec.frame = 0.05;
  ModuleLayout const upright(spec, "WALL", wall());
  expect_box(upright.cell(upright.modules()[0], 7), {0.2, 0.19}, {0.35, 0.33});
  EXPECT_EQ(upright.diode(7), 0);
  EXPECT_EQ(upright.diode(11), 2);
  spec.orientation = PvModules::Orientation::landscape;
  ModuleLayout const flat(spec, "WALL", wall());
  ASSERT_EQ(flat.modules().size(), 6U);  // 2 x 3 of 1.5 m x 1 m
  auto const low = flat.modules()[0].box.low;
  expect_box(flat.cell(flat.modules()[0], 7), low + glm::dvec2(0.19, 0.2),
             low + glm::dvec2(0.33, 0.35));
}

TEST(ModuleLayout, LeavesOutModulesAcrossEdgesAndOpenings) {
  auto roof = wall();
  roof.holes.push_back({{2.2, 2, 1.1}, {2.8, 2, 1.1}, {2.8, 2, 1.9}, {2.2, 2, 1.9}});
  auto spec = modules_of(1.0, 1.0);
  spec.columns = 6;  // one more on each side
  spec.rows = 3;
  ModuleLayout const layout(spec, "ROOF", roof);
  EXPECT_EQ(layout.modules().size(), 11U);  // 4 x 3 but for the one at the skylight
  // The opening lies inside of one module, whose middle is beside it.
  roof.holes = {{{2.1, 2, 1.1}, {2.2, 2, 1.1}, {2.2, 2, 1.2}, {2.1, 2, 1.2}}};
  EXPECT_EQ(ModuleLayout(spec, "ROOF", roof).modules().size(), 11U);
}

TEST(ModuleLayout, SaysThatNoModuleFits) {
  EXPECT_THAT([] { ModuleLayout(modules_of(5.0, 1.0), "WALL", wall()); },
              testing::ThrowsMessage<Error>("GPUShading:PVModules M: no module of 5 m x 1 m fits "
                                            "on WALL, 4 m x 3 m"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
