#include <fmt/format.h>
#include <gmock/gmock.h>

#include <limits>

#include "model/ground_views.h"
#include "model/idf/local_environment.h"
#include "model/idf/model_file.h"
#include "model/idf/model_text.h"
#include "model/reflected_light_input.h"
#include "model/reflected_light_plan.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr char const* rules =
    "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,World;Construction,Glass,Clear;"
    "WindowMaterial:Glazing,Clear,SpectralAverage,,0.006,0.775,0.071,0.08;\n";
// Facing south, up and down; a roof that rises by 3 on 4.
constexpr char const* south = "0,0,3,0,0,0,4,0,0,4,0,3;\n";
constexpr char const* up = "0,0,3,4,0,3,4,4,3,0,4,3;\n";
constexpr char const* down = "0,0,3,0,4,3,4,4,3,4,0,3;\n";
constexpr char const* slope = "0,4,3,0,0,0,4,0,0,4,4,3;\n";

std::string wall(std::string const& name, std::string const& view = "",
                 std::string const& corners = south, std::string const& kind = "Wall",
                 std::string const& construction = "Bricks") {
  return fmt::format("BuildingSurface:Detailed,{},{},{},Room,,Outdoors,,SunExposed,,{},,{}", name,
                     kind, construction, view, corners);
}

std::string window(std::string const& name, std::string const& wall, std::string const& view = "",
                   std::string const& kind = "Window", std::string const& corners = south) {
  return fmt::format("FenestrationSurface:Detailed,{},{},Glass,{},,{},,,4,{}", name, kind, wall,
                     view, corners);
}

ReflectedLightInput read_input(std::string const& idf, std::string const& more = "") {
  auto const parsed = parse_idf(idf);
  auto const objects = read_idf(parsed);
  return read_reflected_light(objects, read_idf(more), read_shading_input(objects),
                              [&](Names const& names) { return find_mentions(parsed, names); });
}

std::map<std::string, double> views(std::string const& idf) {
  auto const objects = read_idf(idf);
  std::map<std::string, double> found;
  for (auto const& [name, surface] : exposed_surfaces(objects)) found[name] = surface.ground_view;
  return found;
}

std::vector<std::string> receivers(ReflectedLightInput const& input) {
  std::vector<std::string> names;
  for (auto const& receiver : input.light.receivers) names.push_back(receiver.surface);
  return names;
}

TEST(GroundViews, FollowTheTiltOfEachType) {
  auto const found = views(std::string(rules) + wall("South") + wall("Deck", "", up, "Roof") +
                           wall("Bridge", "", down, "Floor") + wall("Slope", "", slope, "Roof") +
                           "Wall:Detailed,Old,B,Room,,Outdoors,,,,,4," + south +
                           "RoofCeiling:Detailed,Old Roof,B,Room,,Outdoors,,,,,4," + up +
                           "Floor:Detailed,Old Floor,B,Room,,Outdoors,,,,,4," + down +
                           "Wall:Exterior,Simple,B,Room,,180;Wall:Exterior,Leaning,B,Room,,180,60;"
                           "Roof,Flat,B,Room,,0;Roof,Pitched,B,Room,,180,60;"
                           "Window,Pane,G,Leaning;Door,Door,G,South;GlazedDoor,Skylight,G,Flat;" +
                           window("Glass", "Slope", "", "Window", slope));
  EXPECT_EQ(found.at("SOUTH"), 0.5);
  EXPECT_EQ(found.at("DECK"), 0.0);
  EXPECT_EQ(found.at("BRIDGE"), 1.0);
  EXPECT_NEAR(found.at("SLOPE"), (1 - 4.0 / 5.0) / 2, 1e-9);
  EXPECT_EQ(found.at("OLD"), 0.5);
  EXPECT_EQ(found.at("OLD ROOF"), 0.0);
  EXPECT_EQ(found.at("OLD FLOOR"), 1.0);
  EXPECT_EQ(found.at("SIMPLE"), 0.5);
  EXPECT_NEAR(found.at("LEANING"), 0.25, 1e-12);
  EXPECT_EQ(found.at("FLAT"), 0.0);
  EXPECT_NEAR(found.at("PITCHED"), 0.25, 1e-12);
  EXPECT_NEAR(found.at("PANE"), 0.25, 1e-12);
  EXPECT_EQ(found.at("DOOR"), 0.5);
  EXPECT_EQ(found.at("SKYLIGHT"), 0.0);
  EXPECT_NEAR(found.at("GLASS"), 0.1, 1e-9);
}

TEST(GroundViews, ClockwiseVerticesFaceTheOtherWay) {
  auto const found = views("GlobalGeometryRules,UpperLeftCorner,Clockwise,World;" +
                           wall("Deck", "", down, "Roof"));
  EXPECT_EQ(found.at("DECK"), 0.0);
}

TEST(GroundViews, OnlySurfacesThatTheSunCanReach) {
  EXPECT_THAT(views(std::string(rules) +
                    "BuildingSurface:Detailed,Shaded,Wall,B,Room,,Outdoors,,NoSun,,,," + south +
                    "BuildingSurface:Detailed,Inside,Wall,B,Room,,Adiabatic,,,,,," + south +
                    "BuildingSurface:Detailed,Buried,Wall,B,Room,,Ground,,,,,," + south +
                    "BuildingSurface:Detailed,Nowhere,Wall,B,Room,,,,,,,," + south +
                    window("Between", "Inside") + window("Lost", "No Such Wall") +
                    "Wall:Adiabatic,Party,B,Room;" + wall("Twice") + wall("twice") + wall("")),
              IsEmpty());
  EXPECT_THAT(views(wall("South")), IsEmpty());  // no GlobalGeometryRules
}

TEST(GroundViews, HostileGeometryIsUnknown) {
  for (std::string const corners :
       {"0,0,3,0,0,0;\n", "0,0,3,0,0,0,4,0;\n", "nan,0,3,0,0,0,4,0,0;\n", ";\n",
        "1e300,0,3,0,0,0,4,0,0;\n", "0,0,3,0,0,3,0,0,3;\n", "0,0,3,1,0,3,2,0,3;\n"}) {
    auto const idf = rules + wall("W", "", corners) + wall("South") +
                     window("Pane", "South", "", "Window", corners);
    auto const found = views(idf);
    EXPECT_FALSE(found.at("W") >= 0.0) << corners;
    EXPECT_FALSE(found.at("PANE") >= 0.0) << corners;
    EXPECT_THAT(receivers(read_input(idf)), ElementsAre("SOUTH"));
  }
  auto const tilted = views(std::string(rules) +
                            "Wall:Exterior,W,B,Room,,180,-5;"
                            "Roof,R,B,Room,,180,steep;");
  EXPECT_FALSE(tilted.at("W") >= 0.0);
  EXPECT_FALSE(tilted.at("R") >= 0.0);
  // EnergyPlus turns them.
  EXPECT_FALSE(views(rules + wall("F", "", up, "Floor")).at("F") >= 0.0);
  EXPECT_FALSE(views(rules + wall("R", "", down, "Roof")).at("R") >= 0.0);
}

TEST(GroundViews, AStretchedModelHasUnknownSlopes) {
  auto const found = views(
      "GlobalGeometryRules,UpperLeftCorner,Counterclockwise,Relative;"
      "GeometryTransform,XY,1,2;" +
      wall("South") + wall("Slope", "", slope, "Roof"));
  EXPECT_EQ(found.at("SOUTH"), 0.5);
  EXPECT_FALSE(found.at("SLOPE") >= 0.0);
}

TEST(ReflectedLight, EachReceiverGetsAGroundOfItsOwn) {
  auto const input = read_input(rules + wall("South") + window("Pane", "South"));
  ASSERT_THAT(receivers(input), ElementsAre("PANE", "SOUTH"));
  auto const& pane = input.light.receivers.front();
  EXPECT_EQ(pane.schedule, "GPU SHADING GROUND OF PANE");
  EXPECT_EQ(pane.ground_view, 0.5);
  EXPECT_THAT(input.changes, IsEmpty());
  EXPECT_THAT(input.remarks, IsEmpty());
  std::string added;
  for (auto const& objects : {input.added, constant_schedules(input.light)}) {
    for (auto const& object : objects) added += format_idf(object.type, idf_fields(object));
  }
  EXPECT_THAT(added, HasSubstr("SurfaceProperty:LocalEnvironment,\n  GPU SHADING GROUND OF PANE,\n"
                               "  Pane,\n  ,\n  ,\n  ,\n  GPU SHADING GROUND OF PANE;\n"));
  EXPECT_THAT(added, HasSubstr("SurfaceProperty:GroundSurfaces,\n  GPU SHADING GROUND OF PANE,\n"
                               "  GROUND,\n  0.5,\n  ,\n  GPU SHADING GROUND OF PANE;\n"));
  EXPECT_THAT(added,
              HasSubstr("Schedule:Constant,\n  GPU SHADING GROUND OF PANE,\n  GPU SHADING GROUND,\n"
                        "  1e-09;\n"));
}

TEST(ReflectedLight, TypedViewFactorsOfTheUserStay) {
  auto const input = read_input(rules + wall("None") + wall("Half", "0.5") + wall("Near", "0.495") +
                                wall("Auto", "AutoCalculate") + wall("Claim", "0.3") +
                                wall("Odd", "much") + window("Pane", "Half", "0"));
  EXPECT_THAT(receivers(input), ElementsAre("AUTO", "HALF", "NEAR", "NONE"));
  EXPECT_EQ(input.light.receivers[2].ground_view, 0.495);
  EXPECT_THAT(input.changes, IsEmpty());
  EXPECT_THAT(input.remarks,
              ElementsAre("EnergyPlus's own light from the ground is kept for 3 surfaces (View "
                          "Factor to Ground is not (1 - cos(tilt)) / 2): CLAIM, ODD, PANE"));
}

TEST(ReflectedLight, SurfacesThatFaceUpSeeAGround) {
  auto const input =
      read_input(rules + wall("Blank", "", up, "Roof") + wall("Zero", "0", up, "Roof") +
                 wall("One", "1", up, "Roof") + "Roof,Simple,B,Room;Window,Skylight,Glass,Blank;" +
                 window("Dome", "Blank", "", "TubularDaylightDome", up));
  ASSERT_THAT(receivers(input), ElementsAre("BLANK", "ZERO"));
  EXPECT_EQ(input.light.receivers[0].ground_view, 1.0);
  ASSERT_EQ(input.changes.size(), 2U);
  EXPECT_EQ(input.changes[0].object, "Blank");
  EXPECT_EQ(input.changes[0].field.index, 9U);
  EXPECT_EQ(input.changes[0].value, 1.0);
  auto const ground =
      std::ranges::find(input.added, "SurfaceProperty:GroundSurfaces", &NewObject::type);
  ASSERT_NE(ground, input.added.end());
  EXPECT_EQ(ground->items[0][1].value, 1e-17);
  EXPECT_THAT(input.remarks,
              UnorderedElementsAre(HasSubstr(": DOME"), HasSubstr(": ONE"),
                                   HasSubstr("without the field View Factor to Ground): SIMPLE, "
                                             "SKYLIGHT")));
}

TEST(ReflectedLight, GreenRoofsKeepTheirs) {
  auto const input = read_input(rules + wall("Meadow", "", slope, "Roof", "Green") +
                                wall("South", "", south, "Wall", "B") +
                                "Construction,Green,Grass,Bricks;Construction,B,Bricks;"
                                "Material:RoofVegetation,Grass,0.5,5,0.2;");
  EXPECT_THAT(receivers(input), ElementsAre("SOUTH"));
  EXPECT_THAT(input.remarks, ElementsAre(HasSubstr("(Material:RoofVegetation): MEADOW")));
}

TEST(ReflectedLight, ReflectancesAreThoseOfTheOutsideLayers) {
  auto const input =
      read_input(rules + wall("White", "", south, "Wall", "White") +
                 wall("Default", "", south, "Wall", "Odd") +
                 wall("Lost", "", south, "Wall", "No Such Construction") +
                 wall("Board", "", south, "Wall", "Board") + "Door,Entry,White,White;" +
                 window("Hatch", "White", "", "Door") + window("Pane", "White") +
                 "BuildingSurface:Detailed,Inside,Wall,White,Room,,Adiabatic,,,,,," + south +
                 "Construction,White,Paint,Brick;Construction,Odd,Brick;Construction,Board,Board;"
                 "Material,Paint,Rough,0.01,1,1,1,0.9,0.1;Material,Brick,Rough,0.1,1,1,1;"
                 "Material:NoMass,Board,Rough,2,0.9,7;");
  EXPECT_THAT(input.light.reflectances,
              ElementsAre(testing::Pair("BOARD", 0.0), testing::Pair("DEFAULT", 1.0 - 0.7),
                          testing::Pair("ENTRY", 0.9), testing::Pair("HATCH", 1.0 - 0.7),
                          testing::Pair("LOST", 1.0 - 0.7), testing::Pair("WHITE", 0.9)));
}

TEST(ReflectedLight, GlassIsAMirror) {
  auto const shade = [](std::string const& name, std::string const& properties) {
    return "Shading:Building:Detailed," + name + ",," + south + "ShadingProperty:Reflectance," +
           name + "," + properties + ";";
  };
  auto const input =
      read_input(rules + wall("South") + window("Pane", "South") +
                 window("Hatch", "South", "", "Door") + "GlazedDoor,Entry,Rated,South;" +
                 "BuildingSurface:Detailed,Inside,Wall,B,Room,,Adiabatic,,,,,," + south +
                 window("Within", "Inside") + shade("Tower", "0.5,0.5,0.25,glass") +
                 shade("Fence", "0.5,0.5,0,Glass") + shade("Booth", "0.5,0.5,1,Lost") +
                 "Window,Slit,Measured,South;"
                 "Construction,Rated,System;Construction,Measured,Spectrum;"
                 "WindowMaterial:Glazing,Spectrum,Spectral,Data,0.006;"
                 "WindowMaterial:SimpleGlazingSystem,System,2.0,0.4;");
  EXPECT_THAT(input.light.mirrors,
              ElementsAre(testing::Pair("ENTRY", testing::DoubleNear(0.48237, 6e-6)),
                          testing::Pair("PANE", testing::DoubleNear(0.071, 1e-12)),
                          testing::Pair("TOWER", testing::DoubleNear(0.071, 1e-12))));
  EXPECT_THAT(input.remarks, ElementsAre(HasSubstr("reflects nothing: SLIT, BOOTH")));
}

TEST(ReflectedLight, LocalEnvironmentsOfTheModelAreUsed) {
  auto const input = read_input(
      rules + wall("A") + wall("B") + wall("C") + wall("D") + wall("E") + wall("F") +
      "SurfaceProperty:LocalEnvironment,Blank,a;"
      "SurfaceProperty:LocalEnvironment,Own,B,,,,Lawn;SurfaceProperty:GroundSurfaces,Lawn,G,0.5;"
      "SurfaceProperty:LocalEnvironment,Once,C;SurfaceProperty:LocalEnvironment,Again,C;"
      "SurfaceProperty:LocalEnvironment,,D;"
      "SurfaceProperty:LocalEnvironment,Around,E,,Town;"
      "SurfaceProperty:SurroundingSurfaces,Town,0.4,,0.3,Warm,House,0.3,Cool;"
      "SurfaceProperty:LocalEnvironment,Unclear,F,,Village;"
      "SurfaceProperty:SurroundingSurfaces,Village,0.4,,,,House,0.3,Cool;");
  EXPECT_THAT(receivers(input), ElementsAre("A", "E"));
  ASSERT_EQ(input.changes.size(), 2U);
  EXPECT_EQ(input.changes[0].object, "Blank");
  EXPECT_EQ(input.changes[0].field.index, 5U);
  EXPECT_EQ(input.changes[0].value, "GPU SHADING GROUND OF A");
  EXPECT_EQ(input.changes[1].object, "Around");
  ASSERT_EQ(input.added.size(), 3U);
  EXPECT_THAT(idf_fields(input.added[2]), ElementsAre("GPU SHADING GROUND OF E", "GROUND", "0.3",
                                                      "Warm", "GPU SHADING GROUND OF E"));
  EXPECT_THAT(input.remarks, ElementsAre(HasSubstr("with a ground of its own): B, C, D, F")));
}

TEST(ReflectedLight, ViewFactorsOfSurroundingsAreKept) {
  auto const environment = [](LocalEnvironment const& fields) {
    return format_idf(local_environment, idf_fields(environment_object(fields)));
  };
  std::string const ground_name = "GPU SHADING VIEWS OF A";
  std::string const walls = "GPU SHADING VIEWS OF B";
  auto const ground = ground_object(ground_name, {.view = 0.7});
  auto const input = read_input(
      rules + wall("A") + wall("B"),
      environment({.name = ground_name, .surface = "A", .ground = ground_name}) +
          format_idf(ground.type, idf_fields(ground)) +
          environment({.name = walls, .surface = "B", .surroundings = walls}) +
          "SurfaceProperty:SurroundingSurfaces,GPU SHADING VIEWS OF B,0.4,,0.0,,Walls,0.6,Warm;");
  EXPECT_THAT(receivers(input), ElementsAre("A", "B"));
  ASSERT_EQ(input.added.size(), 3U);
  EXPECT_EQ(input.added[0].items[0][1].value, 0.7);
  EXPECT_EQ(input.added[2].items[0][1].value, 1e-17);
  EXPECT_EQ(input.changes[0].object, "GPU SHADING VIEWS OF A");
}

TEST(ReflectedLight, NamesAreFree) {
  auto const input =
      read_input(rules + wall("South") + "Schedule:Constant,GPU Shading Ground of South,,1;");
  EXPECT_EQ(input.light.receivers.front().schedule, "GPU SHADING GROUND 2 OF SOUTH");
}

TEST(ReflectedLight, NamesThatAreNotUtf8Stay) {
  auto const input = read_input(rules + wall("S\xFC\x64"));
  ASSERT_EQ(input.light.receivers.size(), 1U);
  EXPECT_EQ(input.light.receivers.front().surface, upper("S\xFC\x64"));
  EXPECT_THAT(idf_fields(input.added.front())[1], "S\xFC\x64");
}

std::string rewritten(std::string const& text, ReflectedLightInput const& input) {
  Rewrite rewrite{shading_method("PixelCounting")};
  rewrite.changes.insert(rewrite.changes.end(), input.changes.begin(), input.changes.end());
  rewrite.added = input.added;
  return rewrite_idf(text, parse_idf(text), rewrite);
}

TEST(ReflectedLight, TheRestOfTheTextIsTheSameToTheByte) {
  std::string const before = "! note\nVersion,1.2;\r\nShadowCalculation,PixelCounting;\n" +
                             std::string(rules) + wall("South");
  std::string const after = "\nZone,Room;  !- last\n";
  auto const roof = wall("Deck", "", "\n  0,0,3,\n  4,0,3,\n  4,4,3,\n  0,4,3;", "Roof");
  auto const text = before + roof + after;
  auto const result = rewritten(text, read_input(text));
  EXPECT_TRUE(result.starts_with(before));
  auto const rest = result.substr(0, result.find(after) + after.size());
  EXPECT_EQ(std::count(rest.begin(), rest.end(), '\n'), std::count(text.begin(), text.end(), '\n'));
  auto const objects = read_idf(result);
  auto const deck = std::ranges::find(objects, "Deck", &InputObject::name);
  ASSERT_NE(deck, objects.end());
  EXPECT_EQ((*deck)["view_factor_to_ground"], "1.0");
  EXPECT_EQ(deck->list.size(), 12U);
}

TEST(ReflectedLight, BothFormatsAreChangedAlike) {
  auto model = nlohmann::json::parse(R"({
    "GlobalGeometryRules": {"G": {"starting_vertex_position": "UpperLeftCorner",
      "vertex_entry_direction": "Counterclockwise", "coordinate_system": "World"}},
    "BuildingSurface:Detailed": {"Deck": {"surface_type": "Roof", "construction_name": "B",
      "zone_name": "Room", "outside_boundary_condition": "Outdoors", "vertices": [
        {"vertex_x_coordinate": 0, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3},
        {"vertex_x_coordinate": 4, "vertex_y_coordinate": 0, "vertex_z_coordinate": 3},
        {"vertex_x_coordinate": 4, "vertex_y_coordinate": 4, "vertex_z_coordinate": 3}]}},
    "SurfaceProperty:LocalEnvironment": {"Own": {"exterior_surface_name": "deck"}}})");
  auto const objects = read_epjson(model);
  auto const input =
      read_reflected_light(objects, {}, read_shading_input(objects),
                           [&](Names const& names) { return find_mentions(model, names); });
  ASSERT_THAT(receivers(input), ElementsAre("DECK"));
  auto expected = model;
  std::string const name = "GPU SHADING GROUND OF DECK";
  expected["BuildingSurface:Detailed"]["Deck"]["view_factor_to_ground"] = 1.0;
  expected["SurfaceProperty:LocalEnvironment"]["Own"]["ground_surfaces_object_name"] = name;
  expected["SurfaceProperty:GroundSurfaces"][name]["ground_surfaces"] =
      nlohmann::json::array({{{"ground_surface_name", "GROUND"},
                              {"ground_surface_view_factor", 1e-17},
                              {"ground_surface_reflectance_schedule_name", name}}});
  expected["ScheduleTypeLimits"]["GPU SHADING GROUND"] = nlohmann::json::object();
  rewrite_epjson(model, {input.changes, {}, input.added});
  EXPECT_EQ(model, expected);
}

ReflectedLightPlan plan(std::string const& idf, ShadingInput& shading, Options const& options = {},
                        bool can_be_set = true) {
  auto const parsed = parse_idf(idf);
  auto const objects = read_idf(parsed);
  shading = read_shading_input(objects);
  MentionFinder const find = [&](Names const& names) { return find_mentions(parsed, names); };
  return plan_reflected_light({objects, {}, find}, options, can_be_set, shading);
}

bool is_ours(std::string const& more, Reflections reflections = Reflections::automatic) {
  ShadingInput shading;
  Options options;
  options.reflections = reflections;
  return !plan(rules + wall("South") + more, shading, options).input.light.receivers.empty();
}

std::string louvres(std::size_t count) {
  std::string idf;
  for (std::size_t i = 0; i < count; ++i) {
    idf += fmt::format("Shading:Building:Detailed,S{},,,{}", i, south);
  }
  return idf;
}

TEST(ReflectedLightPlan, AutoFollowsTheModel) {
  EXPECT_FALSE(is_ours(""));
  EXPECT_TRUE(is_ours("", Reflections::all));
  EXPECT_FALSE(is_ours("GPUShading:Settings,512;"));
  EXPECT_FALSE(is_ours("GPUShading:SurroundingGroup,G,S*,;"));
  auto const canopy = louvres(1) + "GPUShading:TransparentShade,Glass,S0,Constant,0.5;";
  EXPECT_TRUE(is_ours(canopy));
  EXPECT_FALSE(is_ours(canopy, Reflections::energyplus));
  EXPECT_TRUE(is_ours("GPUShading:Geometry,Tree,tree.obj;"));
  std::string const building = "Building,B,,,,,FullExteriorWithReflections;";
  EXPECT_FALSE(is_ours(building + louvres(19)));
  EXPECT_TRUE(is_ours(building + louvres(20)));
  EXPECT_FALSE(is_ours(building + louvres(20), Reflections::energyplus));
  EXPECT_FALSE(is_ours(louvres(200)));
}

TEST(ReflectedLightPlan, TheBuildingLosesItsReflections) {
  std::string const idf =
      rules + wall("South") + "Building,B,,,,,FullInteriorAndExteriorWithReflections;" +
      "Output:Variable,*,Surface Outside Face Incident Beam To Beam Surface Reflected Solar "
      "Radiation Rate per Area;Output:Variable,*,Surface Outside Face Incident Solar Radiation "
      "Rate per Area;Daylighting:Controls,Lamp;";
  Options options;
  options.reflections = Reflections::all;
  ShadingInput shading;
  auto const ours = plan(idf, shading, options);
  EXPECT_FALSE(shading.reflections);
  ASSERT_EQ(ours.input.changes.size(), 1U);
  EXPECT_EQ(ours.input.changes[0].field.index, 5U);
  EXPECT_EQ(ours.input.changes[0].value, "FullInteriorAndExterior");
  EXPECT_THAT(ours.remarks, ElementsAre(HasSubstr("EnergyPlus reads FullInteriorAndExterior")));
  EXPECT_THAT(ours.warnings, ElementsAre(HasSubstr(": Surface Outside Face Incident Beam To Beam"),
                                         HasSubstr("daylighting")));
  options.reflections = Reflections::energyplus;
  auto const theirs = plan(idf, shading, options);
  EXPECT_TRUE(shading.reflections);
  EXPECT_THAT(theirs.warnings, IsEmpty());
}

TEST(ReflectedLightPlan, WarningsTellOfLightThatIsNotDimmed) {
  ShadingInput shading;
  auto const idf =
      rules + wall("South") + louvres(1) + "GPUShading:TransparentShade,Glass,S0,Constant,0.5;";
  auto const unset = plan(idf, shading, {}, false);
  EXPECT_THAT(unset.input.light.receivers, IsEmpty());
  EXPECT_THAT(unset.warnings, ElementsAre(HasSubstr("which GPUShading objects do not dim")));
  Options options;
  options.reflections = Reflections::energyplus;
  EXPECT_THAT(plan(idf, shading, options).warnings, ElementsAre(HasSubstr("neither reflect")));
  EXPECT_THAT(plan(idf, shading, {}).warnings, IsEmpty());
  options = {};
  options.mode = Mode::off;
  EXPECT_THAT(plan(idf, shading, options).input.light.receivers, IsEmpty());
}

}  // namespace
}  // namespace gpu_shading::energyplus
