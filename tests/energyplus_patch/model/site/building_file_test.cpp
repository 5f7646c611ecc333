#include "model/site/building_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

constexpr char const* square = "[[[8,47],[8.001,47],[8.001,47.001],[8,47.001],[8,47]]]";

std::string feature(std::string const& properties, std::string const& more = "") {
  return std::string(R"({"type": "Feature", "properties": )") + properties +
         R"(, "geometry": {"type": "Polygon", "coordinates": )" + square + "}" + more + "}";
}

std::string collection(std::string const& features, std::string const& more = "") {
  return R"({"type": "FeatureCollection", "features": [)" + features + "]" + more + "}";
}

HeightRule const usual{"height", "building:levels", 3.0, std::nullopt};

BuildingFile read(std::string const& text, HeightRule const& heights = usual,
                  std::optional<MapCoordinates> const& coordinates = std::nullopt) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "town.geojson";
  std::ofstream(path) << text;
  return read_buildings(path, heights, coordinates);
}

std::string refusal(std::string const& text) {
  return refusal_of([&] { read(text); });
}

TEST(BuildingFile, HeightsAsTheyAreGiven) {
  auto rule = usual;
  rule.storey = 2.5;
  rule.otherwise = 7.0;
  auto const file = read(collection(feature(R"({"height": 12})") + "," +
                                    feature(R"({"height": "12.5 m", "min_height": "3"})") + "," +
                                    feature(R"({"height": null, "building:levels": "4"})") + "," +
                                    feature(R"({"height": ""})") + "," + feature("null")),
                         rule);
  ASSERT_EQ(file.buildings.size(), 5U);
  std::vector<double> tops;
  for (auto const& building : file.buildings) tops.push_back(building.parts.at(0).top);
  EXPECT_THAT(tops, testing::ElementsAre(12.0, 12.5, 10.0, 7.0, 7.0));
  EXPECT_EQ(file.buildings[1].parts[0].base, 3.0);
  rule.height = "hoehe";
  EXPECT_EQ(read(feature(R"({"height": 1, "hoehe": 9})"), rule).buildings[0].parts[0].top, 9.0);
}

TEST(BuildingFile, NamesOfFeatures) {
  auto const file = read(collection(feature(R"({"height": 1})", R"(, "id": "way/7")") + "," +
                                    feature(R"({"height": 1, "name": "Hall", "@id": ""})") + "," +
                                    feature(R"({"height": 1, "osm_id": 17})") + "," +
                                    feature(R"({"height": 1})")));
  std::vector<std::string> names;
  for (auto const& building : file.buildings) names.push_back(building.name);
  EXPECT_THAT(names, testing::ElementsAre("way/7", "Hall", "17", "4"));
}

TEST(BuildingFile, HolesAndPartsOfMultiPolygons) {
  auto const file = read(R"({"type": "Feature", "properties": {"height": 3}, "geometry":
    {"type": "MultiPolygon", "coordinates": [
      [[[0,0],[3,0],[3,3],[0,3],[0,0]],[[1,1],[2,1],[2,2],[1,2],[1,1]]],
      [[[5,0,99],[6,0,99],[6,1,99],[5,0,99]]]]}})");
  ASSERT_EQ(file.buildings.size(), 1U);
  auto const& parts = file.buildings[0].parts;
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].holes.size(), 1U);
  EXPECT_EQ(parts[0].holes[0][1].longitude, 2.0);
  EXPECT_EQ(parts[0].holes[0][1].latitude, 1.0);
  EXPECT_EQ(parts[1].outline.size(), 4U);
}

TEST(BuildingFile, OthersAreCounted) {
  auto const file = read(collection(feature(R"({"height": 3})") +
                                    R"(, {"type": "Feature", "properties": {}, "geometry": null},
         {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [1, 2]}})"));
  EXPECT_EQ(file.buildings.size(), 1U);
  EXPECT_EQ(file.others, 2U);
}

TEST(BuildingFile, CoordinatesAreTheFilesOrTheUsers) {
  // Zurich, by swisstopo's converter: 465 km east, 5,247 km north in zone 32.
  std::string const utm = R"({"type": "Feature", "properties": {"height": 3}, "geometry":
    {"type": "Polygon", "coordinates": [[[465000,5247000],[465010,5247000],[465000,5247010]]]}
    %})";
  auto const with = [&](std::string const& more) {
    auto text = utm;
    return text.replace(text.find('%'), 1, more);
  };
  auto const file = read(
      with(R"(, "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32632"}})"));
  EXPECT_EQ(file.coordinates.name(), "UTM 32N");
  EXPECT_NEAR(file.buildings[0].parts[0].outline[0].longitude, 8.54, 0.01);
  EXPECT_NEAR(file.buildings[0].parts[0].outline[0].latitude, 47.38, 0.01);
  EXPECT_NEAR(
      read(with(""), usual, MapCoordinates::parse("32N")).buildings[0].parts[0].outline[0].latitude,
      47.38, 0.01);
  EXPECT_THAT(refusal(with("")), HasSubstr("are not WGS84 degrees"));
  EXPECT_THAT(refusal(with(R"(, "crs": {"type": "name", "properties": {"name": "EPSG:2056"}})")),
              HasSubstr("crs is \"EPSG:2056\", expected WGS84"));
}

// Blocks of 20 m, 40 m apart along the equator.
std::string row_of_blocks(int count) {
  constexpr double metre = 1.0 / 111'319.49;  // degrees of longitude
  std::string features;
  for (int i = 0; i < count; ++i) {
    double const west = 40.0 * i * metre;
    double const east = west + 20.0 * metre;
    features += fmt::format(
        R"({}{{"type": "Feature", "id": "b{}", "properties": {{"height": 9}}, "geometry": {{"type":
        "Polygon", "coordinates": [[[{},0],[{},0],[{},0.0001],[{},0.0001]]]}}}})",
        i == 0 ? "" : ",", i, west, east, east, west);
  }
  return collection(features);
}

std::vector<std::string> names_near(std::string const& text, geojson::Nearby const& nearby) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "town.geojson";
  std::ofstream(path) << text;
  std::vector<std::string> names;
  for (auto const& building : read_buildings(path, usual, std::nullopt, nearby).buildings)
    names.push_back(building.name);
  return names;
}

TEST(BuildingFile, OnlyThoseNearby) {
  auto const blocks = row_of_blocks(10);
  // Blocks at 80 .. 100, 120 .. 140 and 160 .. 180 m.
  GeographicPoint const centre{0.0, 130.0 / 111'319.49, 0.0};
  using testing::ElementsAre;
  EXPECT_THAT(names_near(blocks, {centre, 29.9}), ElementsAre("b3"));
  EXPECT_THAT(names_near(blocks, {centre, 30.1}), ElementsAre("b2", "b3", "b4"));
  EXPECT_THAT(names_near(blocks, {{0.0, centre.longitude + 360.0, 0.0}, 30.1}),
              ElementsAre("b2", "b3", "b4"));
  EXPECT_THAT(names_near(blocks, {{1.0, 0.0, 0.0}, 1000.0}), testing::IsEmpty());
  // On the other side of the earth.
  EXPECT_THAT(names_near(blocks, {{0.0, -179.999, 0.0}, 1000.0}), testing::IsEmpty());
}

TEST(BuildingFile, SaysWhatIsWrong) {
  EXPECT_THAT(refusal("{"), HasSubstr("town.geojson: is not GeoJSON"));
  EXPECT_THAT(refusal("[1, 2]"), HasSubstr("is not GeoJSON: it has no type"));
  EXPECT_THAT(refusal(collection("")), HasSubstr("has no Polygon"));
  EXPECT_THAT(refusal(collection(feature(R"({"name": "Hall"})"))),
              HasSubstr("feature 1 (Hall): has neither height nor building:levels"));
  EXPECT_THAT(refusal(feature(R"({"height": "high"})")),
              HasSubstr("feature 1: height is \"high\", expected metres"));
  EXPECT_THAT(refusal(feature(R"({"height": "40 ft"})")), HasSubstr("height is \"40 ft\""));
  EXPECT_THAT(refusal(feature(R"({"height": 0})")), HasSubstr("height is 0, expected more than 0"));
  EXPECT_THAT(refusal(feature(R"({"height": 3, "min_height": 3})")),
              HasSubstr("min_height is 3 m"));
  EXPECT_THAT(refusal(R"({"type": "Polygon", "coordinates": [[["8", 47]]]})"),
              HasSubstr("expected two numbers"));
  EXPECT_THAT(refusal(R"({"type": "Polygon", "coordinates": 7})"), HasSubstr("not rings"));
  for (auto const* const height : {"1e308", "-1e308", "\"inf\"", "\"nan\"", "1e999"}) {
    auto const value = std::string(height);
    EXPECT_NE(refusal(feature(R"({"height": )" + value + "}")), "accepted") << value;
    EXPECT_NE(refusal(feature(R"({"building:levels": )" + value + "}")), "accepted") << value;
    EXPECT_NE(refusal(feature(R"({"height": 3, "min_height": )" + value + "}")), "accepted")
        << value;
    EXPECT_NE(refusal(R"({"type": "Polygon", "coordinates": [[[)" + value + ",1],[2,1],[2,2]]]}"),
              "accepted")
        << value;
  }
  std::string const deep(80'000, '[');
  EXPECT_THAT(refusal(R"({"type": "Polygon", "coordinates": )" + deep),
              HasSubstr("is nested more than 100 deep"));
  EXPECT_THROW(read_buildings("/nowhere/town.geojson", {}, std::nullopt), Error);
}

}  // namespace
}  // namespace gpu_shading::energyplus
