#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "model/site/building_file.h"
#include "platform/process.h"
#include "support/refusal.h"

// The files were written by GDAL 3.12 (pyogrio) from one table: with an index, without one, in UTM,
// and as GeoJSON. SQLite has shrunk the pages of the GeoPackages to 512 bytes, so that tables have
// several levels and rows go on in other pages.
namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

std::filesystem::path const corpus = FUZZ_CORPUS;
HeightRule const rule{"height", "building:levels", 3.0, std::nullopt};

std::vector<Building> read(std::filesystem::path const& path,
                           std::optional<geojson::Nearby> const& nearby = std::nullopt) {
  auto buildings = read_buildings(path, rule, std::nullopt, nearby).buildings;
  std::sort(buildings.begin(), buildings.end(),
            [](Building const& a, Building const& b) { return a.name < b.name; });
  return buildings;
}

std::vector<std::string> names(std::vector<Building> const& buildings) {
  std::vector<std::string> names;
  names.reserve(buildings.size());
  for (auto const& building : buildings) names.push_back(building.name);
  return names;
}

void expect_ring(GeographicRing const& found, GeographicRing const& expected, double degrees) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].latitude, expected[i].latitude, degrees);
    EXPECT_NEAR(found[i].longitude, expected[i].longitude, degrees);
  }
}

void expect_same(std::vector<Building> const& found, std::vector<Building> const& expected,
                 double degrees) {
  ASSERT_EQ(names(found), names(expected));
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].parts.size(), expected[i].parts.size()) << found[i].name;
    for (std::size_t part = 0; part < found[i].parts.size(); ++part) {
      auto const& one = found[i].parts[part];
      auto const& other = expected[i].parts[part];
      EXPECT_EQ(one.top, other.top) << found[i].name;
      expect_ring(one.outline, other.outline, degrees);
      ASSERT_EQ(one.holes.size(), other.holes.size());
      for (std::size_t hole = 0; hole < one.holes.size(); ++hole)
        expect_ring(one.holes[hole], other.holes[hole], degrees);
    }
  }
}

std::vector<Building> read_geojson(std::optional<geojson::Nearby> const& nearby = std::nullopt) {
  return read(corpus / "geojson" / "town_gdal.geojson", nearby);
}

std::string bytes_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// By the ending of the files' names.
class IndexedMap : public testing::TestWithParam<char const*> {
 protected:
  static std::filesystem::path file(std::string const& name) {
    std::string const ending = GetParam();
    return corpus / (ending == ".fgb" ? "geojson" : "geo_package") / (name + ending);
  }
};

INSTANTIATE_TEST_SUITE_P(Formats, IndexedMap, testing::Values(".fgb", ".gpkg"),
                         [](auto const& each) { return each.param + 1; });

TEST_P(IndexedMap, HasTheBuildingsOfGeoJson) {
  auto const expected = read_geojson();
  EXPECT_EQ(expected.size(), 36U);
  expect_same(read(file("town")), expected, 1e-12);
  expect_same(read(file("town_no_index")), expected, 1e-12);
  expect_same(read(file("town_utm")), expected, 1e-9);
  auto const found = read_buildings(file("town_utm"), rule, std::nullopt);
  EXPECT_EQ(found.coordinates.name(), "UTM 32N");
  EXPECT_EQ(found.others, 4U);
}

TEST_P(IndexedMap, RadiusFindsWhatItFindsInGeoJson) {
  for (double const radius : {1.0, 100.0, 300.0, 700.0, 2000.0}) {
    for (double const longitude : {8.0, 8.005, 7.99, 368.0}) {
      geojson::Nearby const nearby{{47.001, longitude, 0.0}, radius};
      auto const expected = names(read_geojson(nearby));
      for (char const* name : {"town", "town_no_index", "town_utm"}) {
        EXPECT_EQ(names(read(file(name), nearby)), expected) << name << " " << radius;
      }
    }
  }
  EXPECT_EQ(names(read(file("town"), geojson::Nearby{{47.0, 8.0, 0.0}, 5000.0})).size(), 36U);
}

TEST_P(IndexedMap, IndexLeadsPastWhatIsNotNearby) {
  geojson::Nearby const nearby{{47.0, 8.0, 0.0}, 200.0};
  auto const near = names(read(file("town"), nearby));
  ASSERT_FALSE(near.empty());
  auto const bytes = bytes_of(file("town"));
  TemporaryFolder const temporary;
  auto const path = temporary.path() / "town";
  // Without the properties of the buildings that are farther away.
  auto changed = bytes;
  std::size_t count = 0;
  for (auto const& name : names(read(file("town")))) {
    if (std::find(near.begin(), near.end(), name) != near.end() || name.size() != 6) continue;
    changed.replace(changed.find(name), name.size(), name.size(), '\0');
    ++count;
  }
  ASSERT_GT(count, 9U);
  std::ofstream(path, std::ios::binary) << changed;
  EXPECT_EQ(names(read(path, nearby)), near);
  EXPECT_NE(names(read(path)), names(read(file("town"))));
}

TEST_P(IndexedMap, DamagedFilesAreRefusedOrRead) {
  TemporaryFolder const temporary;
  auto const path = temporary.path() / "town";
  auto const whole = bytes_of(file("town"));
  geojson::Nearby const nearby{{47.0, 8.0, 0.0}, 300.0};
  auto const try_both = [&](std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    refusal_of([&] { read(path); });
    refusal_of([&] { read(path, nearby); });
  };
  for (std::size_t size = 20; size < whole.size(); size += 131) try_both(whole.substr(0, size));
  for (std::size_t at = 16; at < whole.size(); at += 53) {
    auto bytes = whole;
    bytes[at] = static_cast<char>(~bytes[at]);
    try_both(bytes);
  }
  std::ofstream(path, std::ios::binary) << whole.substr(0, 3000);
  EXPECT_THAT(refusal_of([&] { read(path); }), HasSubstr("town: is damaged: "));
}

TEST(GeoPackage, ItsLayersAreReadByName) {
  auto const file = (corpus / "geo_package" / "layers.gpkg").string();
  EXPECT_EQ(names(read(file + "|layername=roads")), (std::vector<std::string>{"way/0", "way/1"}));
  EXPECT_EQ(names(read(file + "|layername=houses")),
            (std::vector<std::string>{"house/0", "house/1"}));
}

TEST(GeoPackage, WhatIsNotWholeIsRefused) {
  auto const folder = corpus / "geo_package";
  EXPECT_THAT(refusal_of([&] { read(folder / "layers.gpkg"); }),
              HasSubstr("layers.gpkg: has 2 layers: roads, houses, expected one, or a name that "
                        "ends in |layername=LAYER"));
  EXPECT_THAT(refusal_of([&] { read(folder / "layers.gpkg|layername=rivers"); }),
              HasSubstr("layers.gpkg: has 2 layers: roads, houses, but not rivers"));
  EXPECT_THAT(refusal_of([&] { read(corpus / "geojson" / "town_gdal.geojson|layername=roads"); }),
              HasSubstr("town_gdal.geojson: is no GeoPackage, but layer roads is asked for"));
  EXPECT_THAT(refusal_of([&] { read(folder / "nameless_column.gpkg"); }),
              HasSubstr("nameless_column.gpkg: is damaged: a column of a table has no name"));
  TemporaryFolder const temporary;
  auto const path = temporary.path() / "town.gpkg";
  std::filesystem::copy_file(folder / "town.gpkg", path);
  std::ofstream(path.string() + "-wal") << "changes";
  EXPECT_THAT(refusal_of([&] { read(path); }), HasSubstr("town.gpkg: has changes in "));
}

}  // namespace
}  // namespace gpu_shading::energyplus
