#include "scene/model_rule.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "model/idf/model_file.h"

namespace gpu_shading::energyplus {
namespace {

// Two zones with a wall each, a set-back window in the first, a fin on it and a tree outside.
constexpr char const* building =
    "BuildingSurface:Detailed,Wall 1,Wall,C,Zone 1,,Outdoors;"
    "BuildingSurface:Detailed,Wall 2,Wall,C,Zone 2,,Outdoors;"
    "FenestrationSurface:Detailed,Window 1,Window,G,Wall 1;"
    "Shading:Zone:Detailed,Fin,Wall 1;"
    "Shading:Site:Detailed,Tree;"
    "ZoneList,First,Zone 1;ZoneList,Second,Zone 2;";

enum Id : SurfaceId { wall_1, wall_2, window_1, reveal, fin, tree, wall_1_closed };
std::vector<std::string> const names{"WALL 1", "WALL 2", "WINDOW 1", "WINDOW 1 reveal 1",
                                     "FIN",    "TREE",   "WALL 1"};
std::vector<WallCopy> const copies{{wall_1, wall_1_closed}};

Scene scene_of(std::vector<std::string> const& surfaces) {
  Scene scene;
  for (auto const& name : surfaces) scene.add({name, {}});
  return scene;
}

ModelRule model_rule(std::string const& objects, std::vector<std::string> const& surfaces = names) {
  return make_shading_rule(read_shading_input(read_idf(building + objects)), scene_of(surfaces),
                           copies);
}

ShadingRule rule_for(std::string const& objects) { return model_rule(objects).rule; }

TEST(ShadingRule, EverythingCasts) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting;");
  for (auto const receiver : {wall_1, wall_2, window_1}) {
    for (auto const caster : {wall_2, fin, tree}) {
      EXPECT_TRUE(rule(receiver, caster)) << names[receiver] << " " << names[caster];
    }
  }
}

TEST(ShadingRule, WallCastsThroughItsOpeningsOnItsWindowsAndWithoutThemOnOthers) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting;");
  EXPECT_TRUE(rule(window_1, wall_1));
  EXPECT_TRUE(rule(window_1, reveal));
  EXPECT_FALSE(rule(window_1, wall_1_closed));
  EXPECT_FALSE(rule(wall_2, wall_1));
  EXPECT_FALSE(rule(wall_2, reveal));
  EXPECT_TRUE(rule(wall_2, wall_1_closed));
}

TEST(ShadingRule, DisabledWithinAndBetweenGroupsOnlyShadingSurfacesCast) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting,,,,,,,,Yes,Yes,First,Second;");
  EXPECT_FALSE(rule(wall_1, wall_2));
  EXPECT_FALSE(rule(wall_2, window_1));
  EXPECT_TRUE(rule(wall_1, tree));
  EXPECT_TRUE(rule(wall_2, fin));
}

TEST(ShadingRule, SetBackWindowStaysInItsWall) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting,,,,,,,,Yes,Yes,First,Second;");
  EXPECT_TRUE(rule(window_1, wall_1));
  EXPECT_TRUE(rule(window_1, reveal));
  EXPECT_FALSE(rule(wall_2, reveal));
}

TEST(ShadingRule, DisabledBetweenGroups) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Second;");
  EXPECT_FALSE(rule(window_1, wall_2));
  EXPECT_TRUE(rule(window_1, fin));
}

TEST(ShadingRule, DisabledWithinOneGroupOfBothZones) {
  auto const rule =
      rule_for("ZoneList,Both,Zone 1,Zone 2;ShadowCalculation,PixelCounting,,,,,,,,Yes,No,Both;");
  EXPECT_FALSE(rule(wall_1, wall_2));
  EXPECT_TRUE(rule(wall_1, tree));
}

TEST(ShadingRule, DisabledWithinSeparateGroupsLeavesThemShadingEachOther) {
  auto const rule = rule_for("ShadowCalculation,PixelCounting,,,,,,,,Yes,No,First,Second;");
  EXPECT_TRUE(rule(wall_1, wall_2));
}

TEST(ShadingRule, MinimalShadowingKnowsRevealsAlone) {
  auto const rule = rule_for("Building,B,0,City,0.04,0.4,MinimalShadowing;");
  EXPECT_TRUE(rule(window_1, reveal));
  EXPECT_TRUE(rule(window_1, wall_1));
  EXPECT_FALSE(rule(window_1, fin));
  EXPECT_FALSE(rule(window_1, tree));
  EXPECT_FALSE(rule(wall_2, fin));
  EXPECT_FALSE(rule(wall_1, wall_2));
}

TEST(ShadingRule, OfThreeGroupsAZoneInTwoCountsForTheLast) {
  auto const rule = rule_for(
      "ZoneList,Both,Zone 1,Zone "
      "2;ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Both,Second;");
  // Zone 1 is of Both, Zone 2 of Second, and each is in Both as well.
  EXPECT_FALSE(rule(wall_1, wall_2));
  EXPECT_FALSE(rule(wall_2, wall_1_closed));
  EXPECT_TRUE(rule(wall_1, tree));
}

TEST(ShadingRule, ChangesWithWhateverItDependsOn) {
  std::vector<ShadingRule> seen;
  auto const expect_new = [&](ShadingRule const& rule, std::string const& what) {
    EXPECT_EQ(std::count(seen.begin(), seen.end(), rule), 0) << what;
    seen.push_back(rule);
  };
  for (std::string const objects : {"", "Building,B,0,City,0.04,0.4,MinimalShadowing;",
                                    "ShadowCalculation,PixelCounting,,,,,,,,Yes,Yes,First,Second;",
                                    "ShadowCalculation,PixelCounting,,,,,,,,Yes,No,First,Second;",
                                    "ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Second;",
                                    "ShadowCalculation,PixelCounting,,,,,,,,Yes,No,First;"}) {
    expect_new(rule_for(objects), objects);
  }
  auto others = names;
  others[reveal] = "WALL 2 reveal 1";
  expect_new(model_rule("", others).rule, "another window's reveal");
  others = names;
  others[window_1] = "WINDOW 2";
  expect_new(model_rule("", others).rule, "a window in no wall");
  auto const input = read_shading_input(read_idf(building));
  expect_new(make_shading_rule(input, scene_of(names), {}).rule, "no copy of the wall");
}

// Surfaces and zones of other names, and groups that make no difference.
TEST(ShadingRule, IsTheSameWhateverThingsAreCalled) {
  auto const rule = [](std::string const& x, std::string const& group) {
    return make_shading_rule(
               read_shading_input(read_idf("BuildingSurface:Detailed," + x + "Wall,Wall,C," + x +
                                           "Zone,,Outdoors;FenestrationSurface:Detailed," + x +
                                           "Window,Window,G," + x + "Wall;ZoneList,List," + x +
                                           "Zone;ZoneList,Elsewhere,Shed;ShadowCalculation,"
                                           "PixelCounting,,,,,,,,Yes,No,List" +
                                           group + ";")),
               scene_of({x + "WALL", x + "WINDOW", x + "WINDOW reveal 1", x + "WALL"}), {{0, 3}})
        .rule;
  };
  EXPECT_EQ(rule("", ""), rule("MY ", ""));
  EXPECT_EQ(rule("", ""), rule("", ",Elsewhere"));
}

TEST(ShadingRule, ZonesOfTheSameGroupsShareANumber) {
  std::string objects = "ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Second;";
  auto surfaces = names;
  for (int i = 3; i < 100; ++i) {
    auto const zone = std::to_string(i);
    objects += fmt::format("BuildingSurface:Detailed,Wall {0},Wall,C,Zone {0},,Outdoors;", zone);
    surfaces.push_back("WALL " + zone);
  }
  auto const made = model_rule(objects, surfaces);
  // Shading surfaces, zone 1, zone 2, and the 97 others.
  ASSERT_EQ(made.zones.size(), 4U);
  EXPECT_EQ(made.zones[1], std::vector<std::string>{"ZONE 1"});
  EXPECT_EQ(made.zones[3].size(), 97U);
}

TEST(ShadingRule, IsDescribedByWhatDoesNotShade) {
  EXPECT_EQ(describe(model_rule("")), "");
  EXPECT_EQ(describe(model_rule("ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Second;")),
            "no shadows on ZONE 1 from ZONE 2\n"
            "no shadows on ZONE 2 from ZONE 1\n");
  EXPECT_EQ(describe(model_rule("Building,B,0,City,0.04,0.4,MinimalShadowing;")),
            "no shadows on shading surfaces from shading surfaces; ZONE 1, ZONE 2\n"
            "no shadows on ZONE 1, ZONE 2 from shading surfaces; ZONE 1, ZONE 2\n");
}

TEST(Reveal, IsKnownByTheNameThatEnergyPlusGives) {
  EXPECT_EQ(window_of_reveal("WINDOW 1 reveal 12"), "WINDOW 1");
  EXPECT_EQ(window_of_reveal("WINDOW 1"), std::nullopt);
  EXPECT_EQ(window_of_reveal("A REVEAL 1"), std::nullopt);
}

}  // namespace
}  // namespace gpu_shading::energyplus
