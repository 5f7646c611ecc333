#include "model/site/terrain_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gpu_shading/error.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

TerrainGrid read(std::string const& text) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.asc";
  std::ofstream(path, std::ios::binary) << text;
  return read_terrain(path, MapCoordinates::parse("UTM 13N"));
}

std::string refusal(std::string const& text) {
  return refusal_of([&] { read(text); });
}

std::string const header = "ncols 3\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n";

TEST(TerrainFile, RowsComeFromTheNorthAndNodesAreCentres) {
  auto const grid = read(header + "NODATA_value -1\n4 5 6\n1 -1 3\n");
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_EQ(grid.first.x, 1005.0);
  EXPECT_EQ(grid.first.y, 2005.0);
  EXPECT_EQ(grid.step_x, 10.0);
  EXPECT_EQ(grid.elevation(0, 0), 1.0);
  EXPECT_TRUE(std::isnan(grid.elevation(1, 0)));
  EXPECT_EQ(grid.elevation(2, 1), 6.0);
  EXPECT_EQ(grid.coordinates.name(), "UTM 13N");
}

TEST(TerrainFile, OtherWaysOfSayingIt) {
  auto const grid = read(
      "NCOLS 2\r\nNROWS 2\r\nXLLCENTER -5\r\nYLLCENTER 7.5\r\ndx 2\r\ndy 3\r\n"
      "1e3 -9999\r\n-9999 +2.5\r\n");
  EXPECT_EQ(grid.first.x, -5.0);
  EXPECT_EQ(grid.first.y, 7.5);
  EXPECT_EQ(grid.step_x, 2.0);
  EXPECT_EQ(grid.step_y, 3.0);
  EXPECT_EQ(grid.elevation(0, 1), 1000.0);
  EXPECT_TRUE(std::isnan(grid.elevation(1, 1)));
  EXPECT_TRUE(std::isnan(grid.elevation(0, 0)));
  EXPECT_EQ(grid.elevation(1, 0), 2.5);
}

TEST(TerrainFile, NotANumberIsNoDataWhereTheHeaderSaysSo) {
  auto const grid = read(header + "NODATA_value nan\nnan 5 6\n1 NaN 3\n");
  EXPECT_TRUE(std::isnan(grid.elevation(0, 1)));
  EXPECT_TRUE(std::isnan(grid.elevation(1, 0)));
  EXPECT_EQ(grid.elevation(2, 0), 3.0);
}

TEST(TerrainFile, SaysWhatIsWrong) {
  EXPECT_THAT(refusal(""), HasSubstr("hill.asc: is not an ESRI ASCII grid: NCOLS is missing"));
  EXPECT_THAT(refusal("ncols three"), HasSubstr("NCOLS is \"three\", expected a number"));
  EXPECT_THAT(refusal("ncols 1\nnrows 2\n"), HasSubstr("NCOLS is 1, expected an integer from 2"));
  EXPECT_THAT(refusal("ncols 2000\nnrows 2000\n"),
              HasSubstr("2000 x 2000 cells, expected at most"));
  EXPECT_THAT(refusal("ncols 2\nnrows 2\ncellsize 0\n"), HasSubstr("CELLSIZE is 0"));
  EXPECT_THAT(refusal("ncols 2\nnrows 2\ncellsize 1\nyllcorner 1\n"),
              HasSubstr("XLLCORNER is missing"));
  EXPECT_THAT(refusal(header + "4 5 6\n1 2"), HasSubstr("ends in row 2 of 2, column 3 of 3"));
  EXPECT_THAT(refusal(header + "4 5 6\n1 2 3 4"), HasSubstr("has more than 3 x 2 elevations"));
  EXPECT_THAT(refusal(header + "4 5 6\n1 x 3"),
              HasSubstr("row 2, column 2 is \"x\", expected a number"));
  EXPECT_THAT(refusal(header + "-9999 -9999 -9999 -9999 -9999 -9999"),
              HasSubstr("all cells are NODATA"));
  EXPECT_THAT(refusal(header + "4 5 6\n1 9001 3"),
              HasSubstr("row 1 from the south, column 2 is 9001 m, expected -500 to 9000"));
  for (auto const* const word : {"inf", "-inf", "1e308", "1e999", "nan"}) {
    EXPECT_THAT(refusal(header + "4 5 6\n1 " + word + " 3"), HasSubstr("column 2 is "));
    EXPECT_THAT(refusal("ncols 2\nnrows 2\ncellsize " + std::string(word)),
                HasSubstr("CELLSIZE is \"" + std::string(word) + "\", expected a number"));
  }
  EXPECT_THROW(read_terrain("/nowhere/hill.asc", {}), Error);
}

// They vanished: all their nodes were at the same place.
TEST(TerrainFile, CellsWithoutSizeAreRefused) {
  auto const of_cells = [](std::string const& size, std::string const& coordinates) {
    TemporaryFolder const folder;
    auto const path = folder.path() / "hill.asc";
    std::ofstream(path) << "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize " << size
                        << "\n4 5 6\n1 2 3\n";
    return refusal_of([&] { read_terrain(path, MapCoordinates::parse(coordinates)); });
  };
  EXPECT_THAT(of_cells("1e-308", "UTM 13N"),
              HasSubstr("hill.asc: its cells are 1e-308 x 1e-308 m, expected at least 0.001"));
  EXPECT_THAT(of_cells("1e-9", "WGS84"),
              HasSubstr("its cells are 1e-09 x 1e-09 degrees, expected at least 1e-08"));
  EXPECT_THAT(of_cells("360", "WGS84"),
              HasSubstr("its rows are 720 degrees long, expected at most 360"));
  EXPECT_EQ(of_cells("1e-3", "UTM 13N"), "accepted");
  EXPECT_EQ(of_cells("1e-8", "WGS84"), "accepted");
}

}  // namespace
}  // namespace gpu_shading::energyplus
