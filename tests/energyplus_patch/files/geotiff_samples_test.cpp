// GeoTIFFs whose bytes are written here as TIFF 6.0, GeoTIFF 1.1 and GDAL's tags define them,
// without the libraries that read them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/site/terrain_file.h"
#include "platform/process.h"
#include "support/refusal.h"

namespace gpu_shading::energyplus {
namespace {

using testing::HasSubstr;

enum class Format : std::uint8_t { whole = 1, signed_whole = 2, real = 3, complex = 6 };

// 3 x 2 cells of 10 m in UTM 33N.
struct Raster {
  unsigned bits = 16;
  Format format = Format::whole;
  unsigned photometric = 1;  // BlackIsZero
  bool big_endian = false;
  bool tiled = false;                       // one tile of 16 x 16
  std::vector<std::uint64_t> samples = {};  // the bits of each
  std::string metadata = {};                // GDAL_METADATA
  std::string no_data = {};                 // GDAL_NODATA
  double pixel_scale = 10.0;
  double scale_z = 0.0;
};

class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}

  void number(std::uint64_t value, unsigned size) {
    for (unsigned i = 0; i < size; ++i) {
      unsigned const shift = 8 * (big_endian_ ? size - 1 - i : i);
      text_ += static_cast<char>(value >> shift & 0xFFU);
    }
  }
  void real(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }
  void append(std::string const& bytes) { text_ += bytes; }
  std::string const& text() const { return text_; }

 private:
  bool big_endian_;
  std::string text_;
};

// Whole bytes in the file's order; other numbers from the highest bit on, each row from a byte on.
std::string row_of(Raster const& raster, std::size_t row, std::size_t columns) {
  Bytes bytes(raster.big_endian);
  unsigned filled = 0;
  unsigned byte = 0;
  for (std::size_t column = 0; column < columns; ++column) {
    std::uint64_t const sample = column < 3 ? raster.samples.at(3 * row + column) : 0;
    if (raster.bits % 8 == 0) {
      bytes.number(sample, raster.bits / 8);
      continue;
    }
    for (unsigned bit = raster.bits; bit-- > 0;) {
      byte = byte << 1U | static_cast<unsigned>(sample >> bit & 1U);
      if (++filled % 8 == 0) bytes.number(std::exchange(byte, 0U), 1);
    }
  }
  if (filled % 8 != 0) bytes.number(byte << (8 - filled % 8), 1);
  return bytes.text();
}

std::string file_of(Raster const& raster) {
  enum Type : unsigned { ascii = 2, short_type = 3, long_type = 4, double_type = 12 };
  constexpr std::size_t side = 16;
  std::string data;
  for (std::size_t row = 0; row < 2; ++row) data += row_of(raster, row, raster.tiled ? side : 3);
  if (raster.tiled) data.resize(data.size() / 2 * side);

  struct Entry {
    unsigned tag;
    unsigned type;
    std::size_t count;
    std::string value;
  };
  auto const shorts = [&](std::initializer_list<unsigned> values) {
    Bytes bytes(raster.big_endian);
    for (unsigned const value : values) bytes.number(value, 2);
    return bytes.text();
  };
  auto const whole = [&](std::size_t value) {
    Bytes bytes(raster.big_endian);
    bytes.number(value, 4);
    return bytes.text();
  };
  auto const doubles = [&](std::initializer_list<double> values) {
    Bytes bytes(raster.big_endian);
    for (double const value : values) bytes.real(value);
    return bytes.text();
  };
  constexpr std::size_t data_at = 8;
  std::vector<Entry> entries{
      {256, long_type, 1, whole(3)},
      {257, long_type, 1, whole(2)},
      {258, short_type, 1, shorts({raster.bits})},
      {259, short_type, 1, shorts({1})},
      {262, short_type, 1, shorts({raster.photometric})},
  };
  if (!raster.tiled) entries.push_back({273, long_type, 1, whole(data_at)});
  entries.push_back({277, short_type, 1, shorts({1})});
  if (raster.tiled) {
    entries.push_back({322, long_type, 1, whole(side)});
    entries.push_back({323, long_type, 1, whole(side)});
    entries.push_back({324, long_type, 1, whole(data_at)});
    entries.push_back({325, long_type, 1, whole(data.size())});
  } else {
    entries.push_back({278, long_type, 1, whole(2)});
    entries.push_back({279, long_type, 1, whole(data.size())});
  }
  entries.push_back({339, short_type, 1, shorts({static_cast<unsigned>(raster.format)})});
  entries.push_back(
      {33550, double_type, 3, doubles({raster.pixel_scale, raster.pixel_scale, raster.scale_z})});
  entries.push_back({33922, double_type, 6, doubles({0, 0, 0, 500'000, 5'000'020, 0})});
  entries.push_back({34735, short_type, 16,
                     shorts({1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32633})});
  auto const text = [&](unsigned tag, std::string value) {
    if (value.empty()) return;
    value += '\0';
    entries.push_back({tag, ascii, value.size(), value});
  };
  text(42112, raster.metadata);
  text(42113, raster.no_data);
  std::sort(entries.begin(), entries.end(),
            [](Entry const& a, Entry const& b) { return a.tag < b.tag; });

  if (data.size() % 2 != 0) data += '\0';
  std::size_t const directory = data_at + data.size();
  std::size_t free = directory + 2 + 12 * entries.size() + 4;
  Bytes file(raster.big_endian);
  file.append(raster.big_endian ? "MM" : "II");
  file.number(42, 2);
  file.number(directory, 4);
  file.append(data);
  file.number(entries.size(), 2);
  std::string beyond;
  for (auto const& [tag, type, count, value] : entries) {
    file.number(tag, 2);
    file.number(type, 2);
    file.number(count, 4);
    if (value.size() <= 4) {
      file.append(value + std::string(4 - value.size(), '\0'));
      continue;
    }
    file.number(free + beyond.size(), 4);
    beyond += value + std::string(value.size() % 2, '\0');
  }
  file.number(0, 4);
  file.append(beyond);
  return file.text();
}

TerrainGrid read(Raster const& raster) {
  TemporaryFolder const folder;
  auto const path = folder.path() / "hill.tif";
  std::ofstream(path, std::ios::binary) << file_of(raster);
  return read_terrain(path, {});
}

// Rows as in the file, from the north.
std::vector<double> elevations(Raster const& raster) {
  auto const grid = read(raster);
  std::vector<double> found;
  for (int row = 1; row >= 0; --row) {
    for (int column = 0; column < 3; ++column) found.push_back(grid.elevation(column, row));
  }
  return found;
}

std::string refusal(Raster const& raster) {
  return refusal_of([&] { read(raster); });
}

constexpr std::uint64_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

TEST(GeoTiffSamples, AreTheStoredIntegersOfEveryDepth) {
  for (unsigned const bits : {1U, 2U, 3U, 4U, 7U, 8U, 10U, 12U, 14U, 16U, 20U, 31U, 32U, 64U}) {
    std::uint64_t const most = bits < 13 ? (std::uint64_t{1} << bits) - 1 : 8848;
    std::vector<std::uint64_t> const samples{0,        most, 1,
                                             most / 2, most, std::min(most, std::uint64_t{100})};
    std::vector<double> const expected(samples.begin(), samples.end());
    for (unsigned const photometric : {0U, 1U}) {  // WhiteIsZero, BlackIsZero
      for (bool const big_endian : {false, true}) {
        for (bool const tiled : {false, true}) {
          EXPECT_EQ(elevations({.bits = bits,
                                .photometric = photometric,
                                .big_endian = big_endian,
                                .tiled = tiled,
                                .samples = samples}),
                    expected)
              << bits << " bits, photometric " << photometric << ", " << big_endian << tiled;
        }
      }
    }
  }
}

TEST(GeoTiffSamples, AreTheStoredSignedIntegersOfEveryDepth) {
  for (unsigned const bits : {10U, 12U, 16U, 20U, 32U, 64U}) {
    std::vector<double> const expected{-5.0, 100.0, 0.0, -500.0, 511.0, -1.0};
    std::vector<std::uint64_t> samples;
    for (double const value : expected) {
      auto const number = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
      samples.push_back(number & (~std::uint64_t{0} >> (64U - bits)));
    }
    EXPECT_EQ(elevations({.bits = bits, .format = Format::signed_whole, .samples = samples}),
              expected)
        << bits;
  }
}

TEST(GeoTiffSamples, AreTheStoredFloatingPointNumbers) {
  std::vector<double> const expected{100.0, -0.5, 0.0, 1.0, 2048.0, -3.0};
  std::vector<std::uint64_t> const halves{0x5640, 0xB800, 0, 0x3C00, 0x6800, 0xC200};
  EXPECT_EQ(elevations({.bits = 16, .format = Format::real, .samples = halves}), expected);
  std::vector<std::uint64_t> floats;
  std::vector<std::uint64_t> doubles;
  for (double const value : expected) {
    floats.push_back(bits_of(static_cast<float>(value)));
    doubles.push_back(std::bit_cast<std::uint64_t>(value));
  }
  for (bool const big_endian : {false, true}) {
    EXPECT_EQ(
        elevations(
            {.bits = 32, .format = Format::real, .big_endian = big_endian, .samples = floats}),
        expected);
    EXPECT_EQ(
        elevations(
            {.bits = 64, .format = Format::real, .big_endian = big_endian, .samples = doubles}),
        expected);
  }
}

std::string gdal_metadata(std::string const& items) {
  return "<GDALMetadata>\n" + items + "</GDALMetadata>\n";
}

TEST(GeoTiffSamples, AreScaledAsGdalSays) {
  Raster raster{.samples = {1000, 2000, 0, 4000, 65535, 10}, .no_data = "65535"};
  raster.metadata = gdal_metadata(
      "  <Item name=\"AREA_OR_POINT\">Area</Item>\n"
      "  <Item name=\"OFFSET\" sample=\"0\" role=\"offset\">-5</Item>\n"
      "  <Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item>\n"
      "  <Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item>\n"
      "  <Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">metre</Item>\n");
  auto found = elevations(raster);
  EXPECT_TRUE(std::isnan(found.at(4)));
  found.at(4) = 0.0;
  EXPECT_EQ(found, (std::vector<double>{495.0, 995.0, -5.0, 1995.0, 0.0, 0.0}));
}

TEST(GeoTiffSamples, WithoutDataAreFoundInTheirOwnPrecision) {
  auto const none = bits_of(-99.1F);
  auto const nan = bits_of(std::numeric_limits<float>::quiet_NaN());
  auto const found =
      elevations({.bits = 32,
                  .format = Format::real,
                  .samples = {none, bits_of(1.0F), none, nan, bits_of(2.0F), bits_of(3.0F)},
                  .no_data = "-99.1"});
  EXPECT_TRUE(std::isnan(found.at(0)) && std::isnan(found.at(2)) && std::isnan(found.at(3)));
  EXPECT_EQ(found.at(5), 3.0);
}

TEST(GeoTiffSamples, ThatAreNotUnderstoodAreRefused) {
  std::vector<std::uint64_t> const samples(6, 100);
  EXPECT_THAT(refusal({.photometric = 5, .samples = samples}),
              HasSubstr("hill.tif: its PhotometricInterpretation is 5, expected 0 or 1"));
  EXPECT_THAT(refusal({.bits = 24, .format = Format::real, .samples = samples}),
              HasSubstr("hill.tif: its BitsPerSample is 24, expected 16, 32 or 64"));
  EXPECT_THAT(refusal({.bits = 24, .samples = samples}),
              HasSubstr("hill.tif: its BitsPerSample is 24, expected 1 to 23, 25 to 32 or 64"));
  EXPECT_THAT(refusal({.bits = 32, .format = Format::complex, .samples = samples}),
              HasSubstr("hill.tif: its SampleFormat is 6, expected 1"));
  EXPECT_THAT(refusal({.samples = samples, .scale_z = 0.1}),
              HasSubstr("hill.tif: its ModelPixelScale has ScaleZ 0.1, expected 0 or 1"));
  EXPECT_THAT(refusal({.samples = samples, .no_data = "none"}),
              HasSubstr("hill.tif: its GDAL_NODATA is \"none\", expected a number"));
  auto const of_item = [&](std::string const& role, std::string const& value) {
    return refusal({.samples = samples,
                    .metadata = gdal_metadata("<Item name=\"X\" sample=\"0\" role=\"" + role +
                                              "\">" + value + "</Item>")});
  };
  EXPECT_THAT(of_item("scale", "0"), HasSubstr("hill.tif: its GDAL SCALE is 0, expected"));
  EXPECT_THAT(of_item("scale", "1,5"), HasSubstr("its GDAL SCALE is \"1,5\", expected a number"));
  EXPECT_THAT(of_item("offset", "nan"), HasSubstr("its GDAL OFFSET is not finite"));
  EXPECT_THAT(of_item("unittype", "ft"),
              HasSubstr("its elevations are in \"ft\", expected metres"));
  EXPECT_THAT(refusal({.samples = samples, .metadata = "<GDALMetadata><Item name=\"SCALE\""}),
              HasSubstr("its GDAL_METADATA is cut off"));
}

// They were taken for cells without data, and the terrain vanished.
TEST(GeoTiffSamples, ThatAreInfiniteAreRefused) {
  std::vector<std::uint64_t> const samples(6, bits_of(std::numeric_limits<float>::infinity()));
  Raster raster{.bits = 32, .format = Format::real, .samples = samples};
  EXPECT_THAT(refusal(raster), HasSubstr("is inf m, expected -500 to 9000 or NODATA"));
  raster.samples.at(0) = bits_of(100.0F);
  EXPECT_THAT(refusal(raster), HasSubstr("is inf m, expected -500 to 9000 or NODATA"));
  raster.no_data = "inf";
  EXPECT_EQ(elevations(raster).at(0), 100.0);
}

TEST(GeoTiffSamples, OfCellsWithoutSizeAreRefused) {
  std::vector<std::uint64_t> const samples(6, 100);
  for (double const size : {0.0, 1e-9}) {
    EXPECT_THAT(refusal({.samples = samples, .pixel_scale = size}),
                HasSubstr("m, expected at least 0.001 each way"))
        << size;
  }
}

}  // namespace
}  // namespace gpu_shading::energyplus
