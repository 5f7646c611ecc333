#include "files/image_decoder/elevations.h"

#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "files/decoding/fail.h"
#include "files/image_decoder/gdal_metadata.h"
#include "files/image_decoder/tiff_file.h"
#include "files/image_decoder/tiff_samples.h"

namespace gpu_shading::decoding {
namespace {

struct FreeKeys {
  void operator()(GTIF* keys) const { GTIFFree(keys); }
};

// A GeoTIFF's header.
class Header {
 public:
  explicit Header(char const* path) : file_(path), keys_(GTIFNew(file_.get())) {
    if (!keys_) fail("has no GeoTIFF keys");
  }

  int size(ttag_t tag) const {
    std::uint32_t value = 0;
    if (TIFFGetField(file_.get(), tag, &value) == 0) fail("its size is missing");
    constexpr std::uint32_t most = 1U << 30U;
    if (value == 0 || value > most) fail("its size is " + std::to_string(value) + " cells");
    return static_cast<int>(value);
  }

  // 0 if it is missing.
  int key(geokey_t name) const {
    unsigned short value = 0;
    return GTIFKeyGetSHORT(keys_.get(), name, &value, 0, 1) == 1 ? value : 0;
  }

  struct Coordinates {
    double x;
    double y;
  };

  // Position of the centre of a cell, counted from the top left cell.
  Coordinates centre(double column, double row) const {
    // A raster of points has them at whole numbers; a raster of areas has the cells' corners there.
    double const half = key(GTRasterTypeGeoKey) == RasterPixelIsPoint ? 0.0 : 0.5;
    Coordinates at{column + half, row + half};
    if (GTIFImageToPCS(keys_.get(), &at.x, &at.y) == 0) {
      fail("is not a GeoTIFF: it does not state the position of its cells");
    }
    return at;
  }

  // Empty if it is missing.
  std::string text(ttag_t tag) const {
    auto const* const field = TIFFFindField(file_.get(), tag, TIFF_ANY);
    if (field == nullptr) return {};
    char const* text = nullptr;
    std::uint32_t count = 0;
    bool const counted = TIFFFieldPassCount(field) != 0;
    int const found = counted ? TIFFGetField(file_.get(), tag, &count, &text)
                              : TIFFGetField(file_.get(), tag, &text);
    if (found == 0 || text == nullptr) return {};
    return counted ? std::string(text, strnlen(text, count)) : std::string(text);
  }

  // An elevation is the stored number, not a multiple of it: ScaleZ is 0 where it is not stated.
  void check_vertical_scale() const {
    std::uint16_t count = 0;
    double const* scale = nullptr;
    if (TIFFGetField(file_.get(), TIFFTAG_GEOPIXELSCALE, &count, &scale) == 0 || count < 3) return;
    if (scale[2] == 0.0 || scale[2] == 1.0) return;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", scale[2]);
    fail(std::string("its ModelPixelScale has ScaleZ ") + text.data() + ", expected 0 or 1");
  }

  TiffFile const& file() const { return file_; }

 private:
  TiffFile file_;
  std::unique_ptr<GTIF, FreeKeys> keys_;
};

// The EPSG code of its coordinate system, 0 if it states none.
int epsg_of(Header const& header) {
  int const code = header.key(GTModelTypeGeoKey) == ModelTypeGeographic
                       ? header.key(GeographicTypeGeoKey)
                       : header.key(ProjectedCSTypeGeoKey);
  return code == KvUserDefined ? 0 : code;
}

ElevationHeader read_header(Header const& file) {
  ElevationHeader header;
  header.columns = file.size(TIFFTAG_IMAGEWIDTH);
  header.rows = file.size(TIFFTAG_IMAGELENGTH);
  auto const first = file.centre(0.0, 0.0);
  auto const right = file.centre(1.0, 0.0);
  auto const below = file.centre(0.0, 1.0);
  if (right.y != first.y || below.x != first.x) {
    fail("its rows do not run east (convert it with gdalwarp)");
  }
  header.x = first.x;
  header.y = first.y;
  header.step_x = right.x - first.x;
  header.step_y = below.y - first.y;
  header.epsg = epsg_of(file);
  int const unit = file.key(VerticalUnitsGeoKey);
  if (unit != 0 && unit != Linear_Meter) fail("its elevations are not in metres");
  file.check_vertical_scale();
  return header;
}

void check_unit(std::string const& unit) {
  std::string lower = unit;
  for (char& letter : lower) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  constexpr std::array<std::string_view, 6> metres{"", "m", "metre", "metres", "meter", "meters"};
  if (std::find(metres.begin(), metres.end(), lower) != metres.end()) return;
  constexpr std::size_t most_shown = 40;
  fail("its elevations are in \"" + unit.substr(0, most_shown) + "\", expected metres");
}

// GDAL_NODATA, in the precision of the numbers that are compared with it; NaN if it is missing.
double no_data_of(Header const& file, bool single_precision) {
  auto const text = file.text(42113);
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double const value = parse_gdal_number("GDAL_NODATA", text);
  if (!single_precision || !std::isfinite(value)) return value;
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<double>(static_cast<float>(std::clamp(value, -most, most)));
}

}  // namespace

Elevations read_elevations(char const* path) {
  Elevations result;
  auto const& header = result.header;
  Header const file(path);
  result.header = read_header(file);
  if (std::int64_t{header.columns} * header.rows > most_elevations) return result;
  auto const metadata = parse_gdal_metadata(file.text(42112));
  check_unit(metadata.unit);
  auto samples = read_samples(file.file());
  double const no_data = no_data_of(file, samples.single_precision);
  for (double& value : samples.values) {
    value = value == no_data ? std::numeric_limits<double>::quiet_NaN()
                             : metadata.scale * value + metadata.offset;
  }
  result.elevations = std::move(samples.values);
  return result;
}

}  // namespace gpu_shading::decoding
