#include "model/reflex_corners.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gpu_shading/scene.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string const rules = "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;\n";

// An L-shaped outline whose reflex corner is the vertex with an index.
Ring shape(int reflex) {
  Ring ring{{0, 0, 2}, {0, 0, 0}, {3, 0, 0}, {3, 0, 0.8}, {1, 0, 0.8}, {1, 0, 2}};
  std::rotate(ring.begin(), ring.begin() + (4 - reflex + 6) % 6, ring.end());
  return ring;
}

std::string vertices(Ring const& ring) {
  std::string text = fmt::format("{}", ring.size());
  for (auto const& point : ring) text += fmt::format(",{},{},{}", point.x, point.y, point.z);
  return text + ";\n";
}

std::string shade(std::string const& name, Ring const& ring) {
  return fmt::format("Shading:Building:Detailed,{},,{}", name, vertices(ring));
}

std::string wall_of(std::string const& name, Ring const& ring, std::string const& outside = "") {
  return fmt::format("BuildingSurface:Detailed,{},Wall,W,Zone,,{},,SunExposed,NoWind,,{}", name,
                     outside.empty() ? "Outdoors" : outside, vertices(ring));
}

std::vector<std::string> found(std::string const& idf, Names const& left_out = {}) {
  auto const objects = read_idf(idf);
  return find_reflex_corners(objects, read_shading_input(objects), left_out);
}

TEST(ReflexCorners, CountWhereEnergyPlusTakesThePlane) {
  std::string shades = rules;
  std::string walls = rules;
  for (int i = 0; i < 6; ++i) {
    shades += shade(fmt::format("Shade {}", i), shape(i));
    walls += wall_of(fmt::format("Wall {}", i), shape(i));
  }
  EXPECT_THAT(found(shades), ElementsAre("SHADE 1", "SHADE 4"));
  EXPECT_THAT(found(shades, {"SHADE 4"}), ElementsAre("SHADE 1"));
  EXPECT_THAT(found(walls), ElementsAre("WALL 1"));
}

TEST(ReflexCorners, FollowTheOrderOfVertices) {
  auto const idf = shade("Shade", shape(2));
  EXPECT_THAT(found(rules + idf), IsEmpty());
  EXPECT_THAT(found("GlobalGeometryRules,UpperLeftCorner,Clockwise,World;\n" + idf),
              ElementsAre("SHADE"));
  EXPECT_THAT(found("GlobalGeometryRules,LowerRightCorner,Counterclockwise,World;\n" + idf),
              ElementsAre("SHADE"));
  EXPECT_THAT(found("GlobalGeometryRules,Middle,Counterclockwise,World;\n" + idf), IsEmpty());
}

TEST(ReflexCorners, IgnoreVerticesThatEnergyPlusDeletes) {
  Ring straight{{0, 0, 2}, {0, 0, 1}, {0, 0, 0}, {3, 0, 0}, {3, 0, 2}};
  for (int turns = 0; turns < 5; ++turns) {
    EXPECT_THAT(found(rules + shade("Shade", straight)), IsEmpty()) << turns;
    std::rotate(straight.begin(), straight.begin() + 1, straight.end());
  }
  auto ring = shape(2);
  ring.insert(ring.begin() + 1, 0.5 * (ring[0] + ring[1]));
  EXPECT_THAT(found(rules + wall_of("Wall", ring)), IsEmpty());
  ring = shape(1);
  ring.insert(ring.begin() + 1, 0.5 * (ring[0] + ring[1]));
  EXPECT_THAT(found(rules + wall_of("Wall", ring)), ElementsAre("WALL"));
}

TEST(ReflexCorners, DoNotMatterIndoors) {
  EXPECT_THAT(found(rules + wall_of("Wall", shape(1), "Adiabatic")), IsEmpty());
}

}  // namespace
}  // namespace gpu_shading::energyplus
