#include "model/geometry_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

// A wall to the south, counter-clockwise from its upper left corner.
Ring const wall{{0, 0, 3}, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}};

void expect_same(Ring const& a, Ring const& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(glm::distance(a[i], b[i]), 0.0, 1e-6) << "vertex " << i;
  }
}

GeometryRules rules_of(std::string const& rules, std::string const& more = "") {
  return read_geometry_rules(read_idf("GlobalGeometryRules," + rules + ";" + more));
}

TEST(GeometryRules, AnyCornerAndDirectionGiveTheSameOutline) {
  Ring const lower_left{wall[1], wall[2], wall[3], wall[0]};
  Ring const lower_right{wall[2], wall[3], wall[0], wall[1]};
  Ring const upper_right{wall[3], wall[0], wall[1], wall[2]};
  auto const outline = [](std::string const& rules, Ring const& vertices) {
    return to_world(rules_of(rules), vertices, Attachment::site).vertices;
  };
  expect_same(outline("UpperLeftCorner,Counterclockwise,World", wall), wall);
  expect_same(outline("LowerLeftCorner,Counterclockwise,World", lower_left), wall);
  expect_same(outline("LowerRightCorner,counterclockwise,world", lower_right), wall);
  expect_same(outline("UpperRightCorner,Counterclockwise,World", upper_right), wall);
  Ring const clockwise{wall[0], wall[3], wall[2], wall[1]};
  expect_same(outline("UpperLeftCorner,Clockwise,World", clockwise), wall);
}

TEST(GeometryRules, RelativeCoordinatesAreTurnedAndMoved) {
  auto const rules =
      rules_of("UpperLeftCorner,Counterclockwise,Relative", "Building,B,90;Zone,Z,90,10,0,1;");
  Ring const point{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  expect_same(to_world(rules, point, Attachment::site).vertices, point);
  // What lay to the east lies to the south.
  expect_same(to_world(rules, point, Attachment::building).vertices,
              {{0, -1, 0}, {0, -2, 0}, {1, -1, 0}});
  // In the zone to the south, then 10 m east of it, then all turned.
  expect_same(to_world(rules, point, Attachment::zone, rules.zones.at("Z")).vertices,
              {{-1, -10, 1}, {-2, -10, 1}, {-1, -11, 1}});
}

TEST(GeometryRules, WorldCoordinatesStayAsTheyAre) {
  auto const rules =
      rules_of("UpperLeftCorner,Counterclockwise,World", "Building,B,90;Zone,Z,90,10,0,1;");
  for (auto const attachment : {Attachment::site, Attachment::building, Attachment::zone}) {
    expect_same(to_world(rules, wall, attachment, rules.zones.at("Z")).vertices, wall);
  }
}

TEST(GeometryRules, VerticesThatEnergyPlusDeletesAreKeptAndNoted) {
  auto const rules = rules_of("UpperLeftCorner,Counterclockwise,World");
  auto const outline = [&](Ring const& ring) { return to_world(rules, ring, Attachment::site); };
  EXPECT_FALSE(outline(wall).simplified);
  Ring near = wall;
  near.insert(near.begin() + 1, {0.003, 0, 0.004});
  expect_same(outline(near).vertices, near);
  EXPECT_TRUE(outline(near).simplified);
  EXPECT_FALSE(outline(near).degenerate);
  // EnergyPlus keeps three vertices, however near.
  Ring const strip{{0, 0, 0.005}, {0, 0, 0}, {4, 0, 0}, {4, 0, 0.005}};
  EXPECT_EQ(outline(strip).vertices.size(), 4U);
  EXPECT_TRUE(outline(strip).simplified);
  EXPECT_TRUE(outline(strip).degenerate);
  Ring const needle{{0, 0, 0.005}, {0, 0, 0}, {4, 0, 0}};
  EXPECT_FALSE(outline(needle).simplified);
  EXPECT_TRUE(outline(needle).degenerate);
  // Vertices are compared before they are rounded to single precision.
  Ring const wide{{0, 0, 5000.010002}, {0, 0, 5000}, {4, 0, 5000}, {4, 0, 5000.010002}};
  EXPECT_FALSE(outline(wide).simplified);
  EXPECT_LT(outline(wide).vertices[0].z, 5000.0099);
}

TEST(GeometryRules, WhatIsNotUnderstoodIsNamed) {
  auto const message = [](std::string const& idf) -> std::string {
    try {
      read_geometry_rules(read_idf(idf));
    } catch (Error const& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("GlobalGeometryRules,Middle,Clockwise,World;"),
              HasSubstr("Starting Vertex Position is \"Middle\""));
  EXPECT_THAT(message("GlobalGeometryRules,UpperLeftCorner,Clockwise,World;Zone,A,north;"),
              HasSubstr("Zone A: Direction of Relative North is \"north\""));
  EXPECT_THAT(message("Zone,A;"), HasSubstr("given 0 times"));
}

}  // namespace
}  // namespace gpu_shading::energyplus
