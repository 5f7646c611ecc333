#include "model/far_outlines.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "model/idf/model_file.h"
#include "model/model_reader.h"

namespace gpu_shading::energyplus {
namespace {

std::string const model =
    "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,Relative;\n"
    "Building,B,0;\nZone,Zone,0,500000,4000000,250;\nZone,Near,0,0,0,0;\n"
    "BuildingSurface:Detailed,Wall,Wall,W,Zone,,Outdoors,,SunExposed,NoWind,,4,"
    "0,0,3,0,0,0,4,0,0,4,0,3;\n"
    "BuildingSurface:Detailed,Home,Wall,W,Near,,Outdoors,,SunExposed,NoWind,,4,"
    "0,0,3,0,0,0,4,0,0,4,0,3;\n"
    "FenestrationSurface:Detailed,Left,Window,W,Wall,,,,,4,"
    "1.03,0,2.1,1.03,0,1.1,1.06,0,1.1,1.06,0,2.1;\n"
    "FenestrationSurface:Detailed,Right,Window,W,Wall,,,,,4,"
    "1.07,0,2.1,1.07,0,1.1,1.1,0,1.1,1.1,0,2.1;\n";

FarOutlines outlines_of(std::string const& idf) {
  auto const objects = read_idf(idf);
  return FarOutlines(objects, read_shading_input(objects), {});
}

Ring ring(double left, double right, double bottom, double top) {
  constexpr double x = 500000;
  constexpr double y = 4000000;
  constexpr double z = 250;
  return {{x + left, y, z + top},
          {x + left, y, z + bottom},
          {x + right, y, z + bottom},
          {x + right, y, z + top}};
}

Ring in_single_precision(Ring ring) {
  for (auto& point : ring) point = glm::dvec3(glm::vec3(point));
  return ring;
}

void expect_same(Ring const& a, Ring const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Heights are small enough for single precision.
    EXPECT_NEAR(glm::distance(a[i], b[i]), 0.0, 2e-5) << "vertex " << i;
  }
}

TEST(FarOutlines, GiveVerticesInDoublePrecision) {
  auto const far = outlines_of(model);
  EXPECT_GE(far.largest(), 4000000);
  Surface wall;
  wall.name = "WALL";
  wall.polygon.outline = in_single_precision(ring(0, 4, 0, 3));
  wall.polygon.holes = {in_single_precision(ring(1.03, 1.06, 1.1, 2.1)),
                        in_single_precision(ring(1.07, 1.1, 1.1, 2.1))};
  EXPECT_TRUE(far.restore(wall));
  expect_same(wall.polygon.outline, ring(0, 4, 0, 3));
  ASSERT_EQ(wall.polygon.holes.size(), 2U);
  expect_same(wall.polygon.holes[0], ring(1.03, 1.06, 1.1, 2.1));
  expect_same(wall.polygon.holes[1], ring(1.07, 1.1, 1.1, 2.1));
  // Unlike single precision:
  EXPECT_GT(glm::distance(in_single_precision(wall.polygon.holes[1])[2], wall.polygon.holes[1][2]),
            0.005);
}

TEST(FarOutlines, LeaveWhatTheModelDoesNotGive) {
  auto const far = outlines_of(model);
  Surface wall;
  wall.name = "WALL";
  auto const moved = in_single_precision(ring(1, 5, 0, 3));
  wall.polygon.outline = moved;
  EXPECT_FALSE(far.restore(wall));
  EXPECT_EQ(wall.polygon.outline, moved);
  wall.polygon.outline = in_single_precision(ring(0, 4, 0, 3));
  wall.polygon.holes = {in_single_precision(ring(2, 3, 1, 2))};
  EXPECT_FALSE(far.restore(wall));
  Surface home;
  home.name = "HOME";
  EXPECT_FALSE(far.restore(home));
  wall.polygon = {in_single_precision(ring(0, 4, 0, 3)), {}};
  EXPECT_FALSE(outlines_of(model + "GeometryTransform,XY,1,2;\n").restore(wall));
}

TEST(FarOutlines, FollowVerticesThatEnergyPlusDeletes) {
  auto const far = outlines_of(
      "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;\n"
      "Shading:Site:Detailed,Shade,,5,500000,4000000,253,500000,4000000,251.5,500000,4000000,250,"
      "500004.1,4000000,250,500004.1,4000000,253;\n");
  Surface shade;
  shade.name = "SHADE";
  shade.polygon.outline = in_single_precision(ring(0, 4.1, 0, 3));
  EXPECT_TRUE(far.restore(shade));
  expect_same(shade.polygon.outline, ring(0, 4.1, 0, 3));
}

TEST(FarOutlines, SinglePrecisionIsCoarse) {
  EXPECT_EQ(single_precision_error(4e6), 0.125);
  EXPECT_EQ(single_precision_error(8191.0), 0.000244140625);
}

TEST(FarOutlines, PlaceholdersStandFartherThanTheModel) {
  auto const distance = [](std::string const& idf) {
    Choices choices;
    auto made = understand(read_idf(idf), "model.idf", choices);
    ensure_placeholders(made.lean, made.shading);
    return made.lean.placeholders.front().distance;
  };
  std::string const star = "Shading:Building:Detailed,Shade,,4,0,-1,0,1,-1,1,2,-1,0,1,-1,3;\n";
  auto near = model;
  near.replace(near.find("500000,4000000"), 14, "50,40");
  EXPECT_EQ(distance(near + star), 1e6);
  EXPECT_GE(distance(model + star), 4e7);
}

}  // namespace
}  // namespace gpu_shading::energyplus
