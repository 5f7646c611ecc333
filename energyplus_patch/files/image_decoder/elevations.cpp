#include "files/image_decoder/elevations.h"

#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "files/decoding/decoder.h"
#include "files/image_decoder/tiff.h"

namespace gpu_shading::decoding {
namespace {

// What GDAL's tag GDAL_METADATA (42112) says of the first channel: its value is
// scale * stored + offset, in the unit.
struct GdalMetadata {
  double scale = 1.0;
  double offset = 0.0;
  std::string unit;  // as written; "": not stated
};

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The value of an attribute, as in <Item name="SCALE" sample="0" role="scale">.
std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
  std::size_t at = tag.find_first_of(blanks);
  while (at != std::string_view::npos) {
    auto const equals = tag.find('=', at);
    if (equals == std::string_view::npos) break;
    auto const quote = tag.find_first_of("\"'", equals);
    if (quote == std::string_view::npos) break;
    auto const end = tag.find(tag[quote], quote + 1);
    if (end == std::string_view::npos) break;
    if (trimmed(tag.substr(at, equals - at)) == name) {
      return tag.substr(quote + 1, end - quote - 1);
    }
    at = end + 1;
  }
  return std::nullopt;
}

// A number and nothing else but blanks: "-9999", "nan", "-inf". Throws std::runtime_error with the
// name of the field.
double parse_gdal_number(std::string const& field, std::string_view text) {
  auto number = trimmed(text);
  // from_chars does not accept a plus sign.
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0.0;
  auto const* const end = number.data() + number.size();
  auto const [stop, error] = std::from_chars(number.data(), end, value);
  if (number.empty() || error != std::errc{} || stop != end) {
    constexpr std::size_t max_shown = 40;
    fail("its " + field + " is \"" + std::string(text.substr(0, max_shown)) +
         "\", expected a number");
  }
  return value;
}

double finite(std::string const& field, std::string_view text) {
  double const value = parse_gdal_number(field, text);
  if (!std::isfinite(value)) fail("its " + field + " is not finite");
  return value;
}

// Parses XML as GDAL writes it. Throws std::runtime_error if SCALE or OFFSET is not a finite number
// or SCALE is 0.
GdalMetadata parse_gdal_metadata(std::string_view xml) {
  GdalMetadata metadata;
  constexpr std::string_view start = "<Item";
  for (auto at = xml.find(start); at != std::string_view::npos; at = xml.find(start, at + 1)) {
    auto const end = xml.find('>', at);
    if (end == std::string_view::npos) fail("its GDAL_METADATA is cut off");
    auto const tag = xml.substr(at, end - at);
    auto const role = attribute(tag, "role");
    if (!role || attribute(tag, "sample") != "0") continue;
    auto const text = xml.substr(end + 1, xml.find('<', end) - end - 1);
    if (role == "scale") metadata.scale = finite("GDAL SCALE", text);
    if (role == "offset") metadata.offset = finite("GDAL OFFSET", text);
    if (role == "unittype") metadata.unit = trimmed(text);
  }
  if (metadata.scale == 0.0) fail("its GDAL SCALE is 0, expected a number other than 0");
  return metadata;
}

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
    constexpr std::uint32_t max_cells = 1U << 30U;
    if (value == 0 || value > max_cells) fail("its size is " + std::to_string(value) + " cells");
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
  constexpr std::size_t max_shown = 40;
  fail("its elevations are in \"" + unit.substr(0, max_shown) + "\", expected metres");
}

// GDAL_NODATA, in the precision of the numbers that are compared with it; NaN if it is missing.
double no_data_of(Header const& file, bool single_precision) {
  auto const text = file.text(42113);
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double const value = parse_gdal_number("GDAL_NODATA", text);
  if (!single_precision || !std::isfinite(value)) return value;
  constexpr double max_float = std::numeric_limits<float>::max();
  return static_cast<double>(static_cast<float>(std::clamp(value, -max_float, max_float)));
}

}  // namespace

Elevations read_elevations(char const* path) {
  Elevations result;
  auto const& header = result.header;
  Header const file(path);
  result.header = read_header(file);
  if (std::int64_t{header.columns} * header.rows > max_elevations) return result;
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
