#include "session/shading_rule.h"

#include <gtest/gtest.h>

#include <set>

#include "input/model_file.h"

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
std::vector<std::string> const names{
    "WALL 1", "WALL 2", "WINDOW 1", "WINDOW 1 reveal 1", "FIN", "TREE", without_openings("WALL 1")};

ShadingRule rule_for(std::string const& objects) {
  return make_shading_rule(read_shading_input(read_idf(building + objects)), names);
}

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

std::vector<std::uint32_t> description(std::string const& objects,
                                       std::vector<std::string> const& surfaces = names) {
  return describe_shading_rule(read_shading_input(read_idf(building + objects)), surfaces);
}

TEST(ShadingRule, DescriptionChangesWithWhateverTheRuleDependsOn) {
  std::set<std::vector<std::uint32_t>> seen;
  for (std::string const objects :
       {"", "Building,B,0,City,0.04,0.4,MinimalShadowing;",
        "ShadowCalculation,PixelCounting,,,,,,,,Yes,Yes,First,Second;",
        "ShadowCalculation,PixelCounting,,,,,,,,Yes,No,First,Second;",
        "ShadowCalculation,PixelCounting,,,,,,,,No,Yes,First,Second;",
        "ShadowCalculation,PixelCounting,,,,,,,,Yes,No,First;",
        "ZoneList,Both,Zone 1,Zone 2;ShadowCalculation,PixelCounting,,,,,,,,Yes,No,Both;"}) {
    EXPECT_TRUE(seen.insert(description(objects)).second) << objects;
  }
  auto others = names;
  others[reveal] = "WALL 2 reveal 1";
  EXPECT_TRUE(seen.insert(description("", others)).second) << "another window's reveal";
  others = names;
  others.back() = "TREE 2";
  EXPECT_TRUE(seen.insert(description("", others)).second) << "no wall without openings";
  others = names;
  others[window_1] = "WINDOW 2";
  EXPECT_TRUE(seen.insert(description("", others)).second) << "a window in no wall";
}

TEST(ShadingRule, DescriptionKnowsNoNames) {
  auto const described = [](std::string const& x) {
    return describe_shading_rule(
        read_shading_input(read_idf("BuildingSurface:Detailed," + x + "Wall,Wall,C," + x +
                                    "Zone,,Outdoors;FenestrationSurface:Detailed," + x +
                                    "Window,Window,G," + x + "Wall;ZoneList,List," + x +
                                    "Zone;ShadowCalculation,PixelCounting,,,,,,,,Yes,No,List;")),
        {x + "WALL", x + "WINDOW", x + "WINDOW reveal 1", without_openings(x + "WALL")});
  };
  EXPECT_EQ(described(""), described("MY "));
}

}  // namespace
}  // namespace gpu_shading::energyplus
