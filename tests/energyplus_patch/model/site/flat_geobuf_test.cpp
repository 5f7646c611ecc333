#include "model/site/flat_geobuf.h"

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

// The files were written by GDAL 3.12 (pyogrio) from one table: town.fgb, and the same without an
// index, in UTM, and as GeoJSON.
namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

std::filesystem::path const folder = FUZZ_CORPUS;
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

std::string bytes_of(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(FlatGeobuf, HasTheBuildingsOfGeoJson) {
  auto const expected = read(folder / "town_gdal.geojson");
  EXPECT_EQ(expected.size(), 36U);
  expect_same(read(folder / "town.fgb"), expected, 1e-12);
  expect_same(read(folder / "town_no_index.fgb"), expected, 1e-12);
  expect_same(read(folder / "town_utm.fgb"), expected, 1e-9);
  auto const file = read_buildings(folder / "town_utm.fgb", rule, std::nullopt);
  EXPECT_EQ(file.coordinates.name(), "UTM 32N");
  EXPECT_EQ(file.others, 4U);
}

TEST(FlatGeobuf, RadiusFindsWhatItFindsInGeoJson) {
  for (double const radius : {1.0, 100.0, 300.0, 700.0, 2000.0}) {
    for (double const longitude : {8.0, 8.005, 7.99, 368.0}) {
      geojson::Nearby const nearby{{47.001, longitude, 0.0}, radius};
      auto const expected = names(read(folder / "town_gdal.geojson", nearby));
      EXPECT_EQ(names(read(folder / "town.fgb", nearby)), expected) << radius;
      EXPECT_EQ(names(read(folder / "town_no_index.fgb", nearby)), expected) << radius;
      EXPECT_EQ(names(read(folder / "town_utm.fgb", nearby)), expected) << radius;
    }
  }
  EXPECT_EQ(names(read(folder / "town.fgb", geojson::Nearby{{47.0, 8.0, 0.0}, 5000.0})).size(),
            36U);
}

TEST(FlatGeobuf, IndexLeadsPastWhatIsNotNearby) {
  geojson::Nearby const nearby{{47.0, 8.0, 0.0}, 200.0};
  auto const near = names(read(folder / "town.fgb", nearby));
  ASSERT_FALSE(near.empty());
  // The name of a building that is farther away.
  std::string far;
  for (auto const& name : names(read(folder / "town.fgb"))) {
    if (std::find(near.begin(), near.end(), name) == near.end() && name.size() == 6) far = name;
  }
  auto bytes = bytes_of(folder / "town.fgb");
  auto const at = bytes.find(far + std::string("\x01", 1));
  ASSERT_NE(at, std::string::npos) << far;
  // The length of its text.
  bytes[at - 1] = '\x7f';
  TemporaryFolder const temporary;
  auto const path = temporary.path() / "town.fgb";
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(names(read(path, nearby)), near);
  EXPECT_THAT(refusal_of([&] { read(path); }),
              HasSubstr("town.fgb: is damaged: a text is too long"));
}

TEST(FlatGeobuf, DamagedFilesAreRefusedOrRead) {
  TemporaryFolder const temporary;
  auto const path = temporary.path() / "town.fgb";
  auto const whole = bytes_of(folder / "town.fgb");
  geojson::Nearby const nearby{{47.0, 8.0, 0.0}, 300.0};
  auto const try_both = [&](std::string const& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    refusal_of([&] { read(path); });
    refusal_of([&] { read(path, nearby); });
  };
  for (std::size_t size = 9; size < whole.size(); size += 131) try_both(whole.substr(0, size));
  for (std::size_t at = 8; at < whole.size(); at += 53) {
    auto bytes = whole;
    bytes[at] = static_cast<char>(~bytes[at]);
    try_both(bytes);
  }
  std::ofstream(path, std::ios::binary) << whole.substr(0, 3000);
  EXPECT_THAT(refusal_of([&] { read(path); }), HasSubstr("town.fgb: is damaged: "));
}

}  // namespace
}  // namespace gpu_shading::energyplus
