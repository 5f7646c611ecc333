#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gpu_shading/error.h"
#include "model/idf/model_file.h"
#include "model/model_reader.h"
#include "model/site/surroundings.h"
#include "surroundings_test.h"

namespace gpu_shading::energyplus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string const location = "Site:Location,Here,0,20,0,100;";

// At the equator, where 0.001 degrees of longitude are 111.3 m.
class SiteContext : public SurroundingsTest {
 protected:
  SiteContext() {
    write("town.geojson", R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "id": "a/1", "properties": {"height": 10}, "geometry": {"type": "Polygon",
        "coordinates": [[[20.001,0],[20.002,0],[20.002,0.001],[20.001,0.001]]]}},
      {"type": "Feature", "id": "b/2", "properties": {"height": 20}, "geometry": {"type": "Polygon",
        "coordinates": [[[19.999,-0.001],[20.0005,-0.001],[20.0005,0.0005],[19.999,0.0005]]]}}]})");
    // A slope of 0.1 to the east, 130 m high at 20 E.
    write("hill.asc",
          "ncols 3\nnrows 3\nxllcenter 19.99\nyllcenter -0.01\ncellsize 0.01\n"
          "18.7 130 241.3\n18.7 130 241.3\n18.7 130 241.3\n");
  }
};

TEST_F(SiteContext, BuildingsStandOnTheTerrain) {
  auto const found =
      read(location + "GPUShading:SiteContext,Town,town.geojson,,,,,,hill.asc,,,,,Terrain;");
  // The ground's four cells, then two houses of a roof and four walls.
  ASSERT_EQ(found.casters.size(), 4U + 5U + 5U);
  EXPECT_EQ(found.casters[0].surface.name, "TOWN:TERRAIN");
  auto const& roof = found.casters[4].surface;
  EXPECT_EQ(roof.name, "TOWN:A/1");
  // 0.001 degrees east of 130 m, ground at 141.1 m, roof 10 m above: 21.1 m over the origin.
  EXPECT_NEAR(roof.polygon.outline[0].z, 21.13, 0.01);
  ASSERT_EQ(found.buildings.size(), 2U);
  EXPECT_NEAR(found.buildings[0].base, 11.13, 0.01);
  EXPECT_EQ(found.types.at("TOWN:B/2"), "GPUShading:SiteContext");
  EXPECT_TRUE(found.warnings.empty());
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_THAT(found.remarks[0], HasSubstr("terrain of 3 x 3 nodes (4 cells drawn), 2 buildings"));
  EXPECT_THAT(found.remarks[0], HasSubstr("20.000000 E 130.0 m (Site:Location, at the terrain's"));
}

TEST_F(SiteContext, WithoutTerrainTheGroundIsAtTheOrigin) {
  auto const found = read(location + "GPUShading:SiteContext,Town,town.geojson;");
  ASSERT_EQ(found.casters.size(), 10U);
  auto const& wall = found.casters[1].surface.polygon.outline;
  EXPECT_NEAR(wall[0].z, 10.0, 2e-3);
  EXPECT_NEAR(wall[1].z, 0.0, 2e-3);
}

TEST_F(SiteContext, WhatIsLeftOut) {
  auto const found = read(location + "GPUShading:SiteContext,Town,town.geojson,,,,,,,,,,,,,,B/*;");
  EXPECT_EQ(found.casters.size(), 5U);
  EXPECT_FALSE(found.types.contains("TOWN:B/2"));
  EXPECT_THAT(found.remarks[0], HasSubstr("1 building (5 walls and roofs, 1 left out)"));
  auto const clear = read(location + "GPUShading:SiteContext,Hill,,,,,,,hill.asc,,2000,,,Terrain;");
  EXPECT_EQ(clear.casters.size(), 0U);
  EXPECT_THAT(clear.remarks[0], HasSubstr("no part of it is left"));
}

TEST_F(SiteContext, WhatIsBeyondTheRadiusIsAHorizon) {
  auto const found =
      read(location + "GPUShading:SiteContext,Town,town.geojson,,,,,,,,,,,,100,1000;");
  // The house b/2 is near, and a/1 stands 111.3 m to the east, from the east to 45 degrees north.
  EXPECT_EQ(found.types.count("TOWN:A/1"), 0U);
  EXPECT_EQ(found.types.at("TOWN:HORIZON"), "GPUShading:SiteContext");
  ASSERT_EQ(found.casters.size(), 5U + 45U);
  EXPECT_EQ(found.buildings.size(), 1U);
  for (std::size_t i = 5; i < found.casters.size(); ++i) {
    auto const& ring = found.casters[i].surface.polygon.outline;
    EXPECT_EQ(found.casters[i].surface.name, "TOWN:HORIZON");
    auto const middle = 0.5 * (ring[0] + ring[3]);
    // The nearest wall has the largest angle.
    EXPECT_NEAR(middle.x, 111.3, 0.1);
    EXPECT_NEAR(middle.z, 10.0, 0.01);
    EXPECT_EQ(ring[1].z, 0.0);
  }
  EXPECT_THAT(found.remarks[0], HasSubstr("1 building within 100 m (5 walls and roofs), horizon of "
                                          "what is within 1000 m (45 degrees)"));
  auto const far = read(location + "GPUShading:SiteContext,Town,town.geojson,,,,,,,,,,,,100,105;");
  EXPECT_EQ(far.casters.size(), 5U);
}

TEST_F(SiteContext, TerrainBeyondTheRadiusIsAHorizon) {
  auto const hill = [&](std::string const& radii) {
    return read(location + "GPUShading:SiteContext,Hill,,,,,,,hill.asc,,,,,Terrain," + radii + ";");
  };
  // All cells have a corner at the origin.
  EXPECT_EQ(hill("1,5000").casters.size(), 4U);
  // Rising to the west, 1,113 m away.
  write("hill.asc",
        "ncols 3\nnrows 3\nxllcenter 19.98\nyllcenter -0.01\ncellsize 0.01\n"
        "241.3 130 18.7\n241.3 130 18.7\n241.3 130 18.7\n");
  auto const found = hill("500,5000");
  ASSERT_EQ(found.casters.size(), 2U + 90U);
  for (auto const& caster : found.casters) {
    auto const& ring = caster.surface.polygon.outline;
    if (caster.surface.name != "HILL:HORIZON") continue;
    auto const middle = 0.5 * (ring[0] + ring[3]);
    EXPECT_LT(middle.x, -1100.0);
    EXPECT_NEAR(middle.z, -0.1 * middle.x, 1.0);
  }
}

TEST_F(SiteContext, HorizonNeedsASmallerRadius) {
  auto const town = [&](std::string const& radii) {
    return refusal(location + "GPUShading:SiteContext,Town,town.geojson,,,,,,,,,,,," + radii + ";");
  };
  EXPECT_THAT(town("100,100"), HasSubstr("Horizon Radius is 100 m, expected more than Radius"));
  EXPECT_THAT(town(",100"), HasSubstr("Horizon Radius is 100 m, expected more than Radius"));
}

TEST_F(SiteContext, OriginIsTheObjectsElseTheModels) {
  std::string const there = "GPUShading:SiteContext,Town,town.geojson,,,,,,,,,0.0,20.001,50";
  EXPECT_NEAR(read(location + there + ";").casters[1].surface.polygon.outline[1].x, 0.0, 1e-6);
  EXPECT_EQ(read(there + ";").casters.size(), 10U);
  // Another object may leave it open, but not differ.
  EXPECT_EQ(read(there + ";GPUShading:SiteContext,More,town.geojson;").casters.size(), 20U);
  EXPECT_THAT(refusal(there + ";GPUShading:SiteContext,More,town.geojson,,,,,,,,,0,20.001,51;"),
              HasSubstr("GPUShading:SiteContext More: its origin differs from that of "
                        "GPUShading:SiteContext Town"));
  EXPECT_THAT(refusal("GPUShading:SiteContext,Town,town.geojson;"),
              HasSubstr("Site:Location is missing"));
  EXPECT_THAT(refusal("GPUShading:SiteContext,Town,town.geojson,,,,,,,,,0,20;"),
              HasSubstr("Site:Location is missing"));
  EXPECT_THAT(refusal("GPUShading:SiteContext,Town,town.geojson,,,,,,,,,5;"),
              HasSubstr("Town: Origin Longitude is blank"));
  EXPECT_THAT(refusal("GPUShading:SiteContext,Town,town.geojson,,,,,,,,,91,0,0;"),
              HasSubstr("Origin Latitude is \"91\", expected a number from -90 to 90 deg"));
}

TEST_F(SiteContext, WarnsOfAnOriginThatCannotBeRight) {
  auto const found = read(location +
                          "GPUShading:SiteContext,Hill,,,,,,,hill.asc;"
                          "GPUShading:SiteContext,Town,town.geojson;");
  EXPECT_THAT(found.warnings,
              ElementsAre(HasSubstr("the terrain is at 130.0 m, the model's ground at 100.0 m")));
  auto const far = read("Site:Location,There,20,0,0,100;GPUShading:SiteContext,Town,town.geojson;");
  EXPECT_THAT(far.warnings, ElementsAre(HasSubstr("farther than 50 km")));
}

TEST_F(SiteContext, SaysWhatIsWrong) {
  auto const of = [&](std::string const& fields) {
    return refusal(location + "GPUShading:SiteContext,Town," + fields + ";");
  };
  EXPECT_THAT(of(""), HasSubstr("Buildings File Name and Terrain File Name are blank"));
  EXPECT_THAT(of("village.geojson"), HasSubstr("village.geojson: no such file"));
  EXPECT_THAT(of("town.geojson,Mars"),
              HasSubstr("Buildings Coordinates is \"Mars\", expected WGS84, a UTM zone"));
  EXPECT_THAT(of("town.geojson,,,,-3"),
              HasSubstr("Storey Height is \"-3\", expected a number above 0"));
  EXPECT_THAT(of("town.geojson,,,,,tall"),
              HasSubstr("Default Height is \"tall\", expected a number above 0"));
  EXPECT_THAT(of("town.geojson,,,,,,,UTM 33N"),
              HasSubstr("Terrain Coordinates is \"UTM 33N\", expected blank without Terrain"));
  EXPECT_THAT(of(",,,,,,hill.asc,UTM 13N"),
              HasSubstr("latitude 0, longitude 20 is too far from UTM 13N"));
  EXPECT_THAT(of("town.geojson,UTM 13N"), HasSubstr("Buildings File Name"));
  EXPECT_THAT(of("town.geojson,,,,,,,,,,,Hill"), HasSubstr("Origin Elevation is \"Hill\""));
  EXPECT_THAT(of("town.geojson,,,,,,,,,,,Terrain"),
              HasSubstr("Origin Elevation is Terrain, but no terrain has data"));
  write("bow.geojson", R"({"type": "Feature", "properties": {"height": 10}, "geometry":
    {"type": "Polygon", "coordinates": [[[20,0],[20.001,0.001],[20.001,0],[20,0.001]]]}})");
  EXPECT_THAT(of("bow.geojson"),
              HasSubstr("Town: Buildings File Name: bow.geojson: feature 1: its outline crosses"));
  write("sea.geojson", R"({"type": "Feature", "properties": {"height": 10}, "geometry":
    {"type": "Polygon", "coordinates": [[[21,0],[21.001,0],[21.001,0.001]]]}})");
  EXPECT_THAT(of("sea.geojson,,,,,,hill.asc"), HasSubstr("feature 1: none of its corners is on"));
}

TEST_F(SiteContext, EpJsonSaysTheSame) {
  auto const objects = read_epjson(nlohmann::json::parse(R"({
    "Site:Location": {"Here": {"latitude": 0, "longitude": 20, "elevation": 100}},
    "GPUShading:SiteContext": {"Town": {"buildings_file_name": "town.geojson", "storey_height": 3,
      "left_out": [{"left_out_name": "a/1"}]}}})"));
  auto const found = read_surroundings(objects, folder_.path());
  EXPECT_EQ(found.casters.size(), 5U);
  EXPECT_TRUE(found.types.contains("TOWN:B/2"));
}

TEST_F(SiteContext, PutsUpPlaceholdersUnlessShadingIsOff) {
  Choices choices;
  choices.folder = folder_.path();
  auto const objects = read_idf(location + "GPUShading:SiteContext,Town,town.geojson;");
  auto const model = understand(objects, folder_.path() / "model.idf", choices);
  EXPECT_EQ(model.lean.placeholders.size(), 4U);
  EXPECT_FALSE(model.lean.active());
  EXPECT_EQ(model.shading.shading_surfaces.at("TOWN:A/1").type, "GPUShading:SiteContext");
  choices.mode = Mode::off;
  EXPECT_TRUE(understand(objects, folder_.path() / "model.idf", choices).lean.placeholders.empty());
  EXPECT_THROW(understand(read_idf("Shading:Site:Detailed,town:a/1;" + location +
                                   "GPUShading:SiteContext,Town,town.geojson;"),
                          folder_.path() / "model.idf", choices),
               Error);
}

TEST_F(SiteContext, LocationIsCheckedUnlessShadingIsOff) {
  auto const objects = read_idf("Site:Location,Here,0,20,nan,100;");
  auto const path = folder_.path() / "model.idf";
  EXPECT_THAT(refusal_of([&] { understand(objects, path, {}); }),
              AllOf(HasSubstr("model.idf: Site:Location Here: Time Zone"), HasSubstr("nan")));
  Choices choices;
  choices.mode = Mode::off;
  EXPECT_NO_THROW(understand(objects, path, choices));
}

TEST_F(SiteContext, TellsTheModelsOwnBuilding) {
  auto const found = read(location + "GPUShading:SiteContext,Town,town.geojson;");
  ShadingInput input;
  input.zone_of = {{"WALL", "ZONE"}, {"NEXT DOOR", "ZONE"}};
  Scene scene;
  Surface next;
  next.name = "NEXT DOOR";  // wall to wall with A/1, facing it
  double const wall = found.casters[1].surface.polygon.outline[0].x;
  next.polygon.outline = {{wall, 20, 5}, {wall, 20, 0}, {wall, 40, 0}, {wall, 40, 5}};
  scene.add(next);
  EXPECT_THAT(warn_of_own_buildings(found.buildings, scene, input), testing::IsEmpty());
  Surface own;
  own.name = "WALL";
  own.polygon.outline = {{5, 0, 3}, {5, 0, 0}, {9, 0, 0}, {9, 0, 3}};
  scene.add(own);
  EXPECT_THAT(warn_of_own_buildings(found.buildings, scene, input),
              ElementsAre(HasSubstr("TOWN:B/2 encloses the model's WALL")));
}

TEST(Covers, OnlyOpaqueRoofsOverAllOfTheModelAreNamed) {
  ShadingInput input;
  input.zone_of = {{"WALL", "ZONE"}, {"EAST", "ZONE"}};
  Scene scene;
  auto const add = [&](std::string const& name, Ring const& outline) {
    Surface surface;
    surface.name = name;
    surface.polygon.outline = outline;
    scene.add(surface);
  };
  auto const roof = [&](std::string const& name, double from, double to, double z) {
    add(name, {{from, -9, z}, {to, -9, z}, {to, 9, z}, {from, 9, z}});
    input.shading_surfaces[name] = {.type = "Shading:Building:Detailed"};
  };
  add("WALL", {{0, 0, 3}, {0, 0, 0}, {4, 0, 0}, {4, 0, 3}});
  add("EAST", {{4, 0, 3}, {4, 0, 0}, {4, 5, 0}, {4, 5, 3}});
  roof("WHOLE", -9, 9, 4);
  roof("PART", -9, 3, 4);
  roof("GROUND", -9, 9, -0.1);
  roof("GLASS", -9, 9, 4);
  roof("SCHEDULED", -9, 9, 4);
  input.shading_surfaces["SCHEDULED"].transmittance_schedule = "LEAVES";
  roof("OVERHANG", -9, 9, 4);
  input.shading_surfaces["OVERHANG"].type = "Shading:Zone:Detailed";
  EXPECT_THAT(warn_of_covers(scene, input, {"GLASS"}),
              ElementsAre("Shading:Building:Detailed WHOLE lies over the whole model: if it is the "
                          "modelled building itself, remove it"));
  EXPECT_THAT(warn_of_covers({}, input, {}), testing::IsEmpty());
}

}  // namespace
}  // namespace gpu_shading::energyplus
