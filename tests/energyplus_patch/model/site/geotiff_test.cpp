
#include <fmt/format.h>
#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "gpu_shading/error.h"
#include "gpu_shading/local_axes.h"
#include "model/site/terrain_file.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

// 3 x 2 cells of 10 units, the north-western one at (1005, 2015), one of them without data.
std::string const ascii =
    "ncols 3\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize 10\nNODATA_value -99\n"
    "4 5 6\n1 -99 -3\n";
std::array<float, 6> const numbers{4.0F, 5.0F, 6.0F, 1.0F, -99.0F, -3.0F};

struct Tiff {
  int model = ModelTypeProjected;
  int epsg = 32613;
  bool points = false;  // numbers are of points, not of areas
  bool whole_numbers = false;
  int channels = 1;
  std::array<double, 16> matrix{};  // 0 throughout: scale and tie point instead
  int vertical_unit = 0;
  bool placed = true;
};

// What the file format says, by its own library.
void write_tiff(std::filesystem::path const& path, Tiff const& what) {
  TIFF* const file = XTIFFOpen(path.c_str(), "w");
  static TIFFFieldInfo const no_data{42113,        -1, -1, TIFF_ASCII,
                                     FIELD_CUSTOM, 1,  0,  const_cast<char*>("GDAL_NODATA")};
  TIFFMergeFieldInfo(file, &no_data, 1);
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, 3);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, 2);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, what.channels);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 1);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, what.whole_numbers ? 16 : 32);
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT,
               what.whole_numbers ? SAMPLEFORMAT_INT : SAMPLEFORMAT_IEEEFP);
  TIFFSetField(file, 42113, "-99");
  if (what.matrix[0] != 0.0) {
    TIFFSetField(file, TIFFTAG_GEOTRANSMATRIX, 16, what.matrix.data());
  } else if (what.placed) {
    std::array<double, 3> const scale{10.0, 10.0, 0.0};
    double const half = what.points ? 5.0 : 0.0;
    std::array<double, 6> const tie{0.0, 0.0, 0.0, 1000.0 + half, 2020.0 - half, 0.0};
    TIFFSetField(file, TIFFTAG_GEOPIXELSCALE, 3, scale.data());
    TIFFSetField(file, TIFFTAG_GEOTIEPOINTS, 6, tie.data());
  }
  GTIF* const keys = GTIFNew(file);
  GTIFKeySet(keys, GTModelTypeGeoKey, TYPE_SHORT, 1, what.model);
  GTIFKeySet(keys, GTRasterTypeGeoKey, TYPE_SHORT, 1,
             what.points ? RasterPixelIsPoint : RasterPixelIsArea);
  if (what.epsg != 0) {
    GTIFKeySet(keys,
               what.model == ModelTypeGeographic ? GeographicTypeGeoKey : ProjectedCSTypeGeoKey,
               TYPE_SHORT, 1, what.epsg);
  }
  if (what.vertical_unit != 0) {
    GTIFKeySet(keys, VerticalUnitsGeoKey, TYPE_SHORT, 1, what.vertical_unit);
  }
  GTIFWriteKeys(keys);
  GTIFFree(keys);
  for (std::size_t row = 0; row < 2; ++row) {
    std::vector<float> line;
    std::vector<std::int16_t> whole;
    for (std::size_t column = 0; column < 3; ++column) {
      for (int channel = 0; channel < what.channels; ++channel) {
        line.push_back(numbers.at(3 * row + column));
        whole.push_back(static_cast<std::int16_t>(numbers.at(3 * row + column)));
      }
    }
    void* const texels =
        what.whole_numbers ? static_cast<void*>(whole.data()) : static_cast<void*>(line.data());
    TIFFWriteScanline(file, texels, static_cast<std::uint32_t>(row));
  }
  XTIFFClose(file);
}

TerrainGrid read(Tiff const& what, std::optional<MapCoordinates> const& coordinates = {}) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.tif";
  write_tiff(path, what);
  return read_terrain(path, coordinates);
}

void expect_as_ascii(TerrainGrid const& grid, std::string const& coordinates) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.asc";
  std::ofstream(path) << ascii;
  auto const expected = read_terrain(path, MapCoordinates::parse(coordinates));
  EXPECT_EQ(grid.coordinates.name(), expected.coordinates.name());
  EXPECT_EQ(grid.columns, expected.columns);
  EXPECT_EQ(grid.rows, expected.rows);
  EXPECT_EQ(grid.first.x, expected.first.x);
  EXPECT_EQ(grid.first.y, expected.first.y);
  EXPECT_EQ(grid.step_x, expected.step_x);
  EXPECT_EQ(grid.step_y, expected.step_y);
  ASSERT_EQ(grid.elevations.size(), expected.elevations.size());
  for (std::size_t i = 0; i < grid.elevations.size(); ++i) {
    if (std::isnan(expected.elevations[i])) {
      EXPECT_TRUE(std::isnan(grid.elevations[i]));
    } else {
      EXPECT_EQ(grid.elevations[i], expected.elevations[i]);
    }
  }
}

TEST(GeoTiff, IsReadAsTheSameNumbersInAscii) {
  expect_as_ascii(read({}), "UTM 13N");
  expect_as_ascii(read({.epsg = 32733}), "UTM 33S");
  expect_as_ascii(read({.points = true}), "UTM 13N");
  expect_as_ascii(read({.whole_numbers = true}), "UTM 13N");
  expect_as_ascii(read({.model = ModelTypeGeographic, .epsg = 4326}), "WGS84");
  expect_as_ascii(read({.vertical_unit = Linear_Meter}), "UTM 13N");
  // Rows from the south, by a matrix: the file's first row is then the southern one.
  auto const upside_down =
      read({.matrix = {10.0, 0.0, 0.0, 1000.0, 0.0, 10.0, 0.0, 2000.0, 0, 0, 0, 0, 0, 0, 0, 1}});
  EXPECT_EQ(upside_down.first.y, 2005.0);
  EXPECT_EQ(upside_down.elevation(0, 0), 4.0);
  EXPECT_EQ(upside_down.elevation(2, 1), -3.0);
}

TEST(GeoTiff, GivenCoordinatesComeFirst) {
  expect_as_ascii(read({.epsg = 0}, MapCoordinates::parse("UTM 12N")), "UTM 12N");
  expect_as_ascii(read({.epsg = 26913}, MapCoordinates::parse("UTM 13N")), "UTM 13N");
}

TEST(GeoTiff, SaysWhatIsWrong) {
  auto const refusal = [](Tiff const& what) { return refusal_of([&] { read(what); }); };
  EXPECT_THAT(refusal({.epsg = 0}), HasSubstr("hill.tif: does not state its coordinates"));
  EXPECT_THAT(refusal({.epsg = 2154}), HasSubstr("is in EPSG:2154, expected WGS84 or UTM"));
  EXPECT_THAT(refusal({.channels = 3}), HasSubstr("3 channels, expected one"));
  EXPECT_THAT(refusal({.placed = false}), HasSubstr("does not state the position of its cells"));
  EXPECT_THAT(refusal({.vertical_unit = Linear_Foot}), HasSubstr("not in metres"));
  EXPECT_THAT(refusal({.matrix = {8, 6, 0, 1000, 6, -8, 0, 2000, 0, 0, 0, 0, 0, 0, 0, 1}}),
              HasSubstr("its rows do not run east"));
  TemporaryFolder const folder;
  auto const cut = folder.path() / "cut.tif";
  std::ofstream(cut, std::ios::binary) << std::string("II*\0\x08\0\0", 7);
  EXPECT_THROW(read_terrain(cut, {}), Error);
}

// 40 x 30 cells, in strips of 7 rows or tiles of 16 x 16, compressed or not.
struct Large {
  bool tiled = false;
  int compression = COMPRESSION_NONE;
  float last = 100.0F;  // its last elevation
};

std::string large(Large const& what, std::filesystem::path const& path) {
  constexpr std::uint32_t columns = 40;
  constexpr std::uint32_t rows = 30;
  constexpr std::uint32_t side = 16;
  TIFF* const file = XTIFFOpen(path.c_str(), "w");
  TIFFSetField(file, TIFFTAG_IMAGEWIDTH, columns);
  TIFFSetField(file, TIFFTAG_IMAGELENGTH, rows);
  TIFFSetField(file, TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(file, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(file, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(file, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(file, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(file, TIFFTAG_COMPRESSION, what.compression);
  if (what.tiled) {
    TIFFSetField(file, TIFFTAG_TILEWIDTH, side);
    TIFFSetField(file, TIFFTAG_TILELENGTH, side);
  } else {
    TIFFSetField(file, TIFFTAG_ROWSPERSTRIP, 7);
  }
  std::array<double, 3> const scale{10.0, 10.0, 0.0};
  std::array<double, 6> const tie{0.0, 0.0, 0.0, 1000.0, 2020.0, 0.0};
  TIFFSetField(file, TIFFTAG_GEOPIXELSCALE, 3, scale.data());
  TIFFSetField(file, TIFFTAG_GEOTIEPOINTS, 6, tie.data());
  GTIF* const keys = GTIFNew(file);
  GTIFKeySet(keys, GTModelTypeGeoKey, TYPE_SHORT, 1, ModelTypeProjected);
  GTIFKeySet(keys, ProjectedCSTypeGeoKey, TYPE_SHORT, 1, 32613);
  GTIFWriteKeys(keys);
  GTIFFree(keys);
  if (what.tiled) {
    std::vector<float> tile(std::size_t{side} * side, 100.0F);
    for (std::uint32_t y = 0; y < rows; y += side) {
      for (std::uint32_t x = 0; x < columns; x += side) {
        TIFFWriteTile(file, tile.data(), x, y, 0, 0);
      }
    }
  } else {
    std::vector<float> line(columns, 100.0F);
    for (std::uint32_t row = 0; row < rows; ++row) {
      if (row == rows - 1) line.back() = what.last;
      TIFFWriteScanline(file, line.data(), row);
    }
  }
  XTIFFClose(file);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string reading(std::filesystem::path const& path) {
  return refusal_of([&] { read_terrain(path, {}); });
}

// They were read as elevation 0.
TEST(GeoTiff, DataThatIsMissingOrDamagedIsRefused) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.tif";
  for (bool const tiled : {false, true}) {
    for (int const compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_LZW}) {
      auto const bytes = large({tiled, compression}, path);
      EXPECT_EQ(read_terrain(path, {}).elevation(39, 29), 100.0);
      // The header lies at the end of what libtiff writes: where its data begin, cut out a part.
      auto const damage = [&](std::size_t from, std::size_t count) {
        auto damaged = bytes;
        damaged.replace(from, count, count, '\xff');
        std::ofstream(path, std::ios::binary) << damaged;
      };
      if (compression != COMPRESSION_NONE) {
        damage(12, 30);
        EXPECT_THAT(reading(path), HasSubstr("is damaged: ")) << tiled << " " << compression;
      }
    }
  }
}

// Sets all numbers of an array in a file's header (TIFF 6.0, section 2), which has the byte order
// of this machine.
void set_numbers(std::string& bytes, std::uint16_t tag, std::uint32_t value) {
  auto const number = [&](std::size_t at, std::size_t size) {
    std::uint32_t found = 0;
    std::memcpy(&found, bytes.data() + at, size);
    return found;
  };
  auto const directory = number(4, 4);
  for (std::size_t i = 0; i < number(directory, 2); ++i) {
    auto const entry = directory + 2 + 12 * i;
    if (number(entry, 2) != tag) continue;
    std::size_t const size = number(entry + 2, 2) == TIFF_SHORT ? 2 : 4;
    auto const count = number(entry + 4, 4);
    auto const at = count * size > 4 ? number(entry + 8, 4) : entry + 8;
    for (std::size_t j = 0; j < count; ++j) std::memcpy(bytes.data() + at + j * size, &value, size);
    return;
  }
  FAIL() << "no tag " << tag;
}

// A header that claims data which the file does not have.
TEST(GeoTiff, DataThatTheHeaderClaimsAreThere) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.tif";
  for (auto const& [tag, value] :
       {std::pair(TIFFTAG_STRIPOFFSETS, 60'000U),  // beyond the end
        std::pair(TIFFTAG_STRIPBYTECOUNTS, 0U), std::pair(TIFFTAG_STRIPBYTECOUNTS, 40U)}) {
    auto bytes = large({}, path);
    set_numbers(bytes, static_cast<std::uint16_t>(tag), value);
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_THAT(reading(path), HasSubstr("is damaged: strip 1 of 5")) << tag << " " << value;
  }
}

TEST(GeoTiff, ElevationsOfNoPlaceOnEarthAreRefused) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.tif";
  for (float const value : {-501.0F, 9001.0F, -32768.0F, 1e30F}) {
    large({.last = value}, path);
    EXPECT_THAT(reading(path), HasSubstr("expected -500 to 9000 or NODATA")) << value;
  }
  large({.last = 8849.0F}, path);
  EXPECT_EQ(read_terrain(path, {}).elevation(39, 0), 8849.0);
}

}  // namespace
}  // namespace gpu_shading::energyplus
