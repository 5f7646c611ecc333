#include "image_decoder/elevations.h"

#include <OpenImageIO/imageio.h>
#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "decoding/fail.h"
#include "image_decoder/tiff_file.h"

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

  // Decodes every strip or tile: readers of pictures take what is missing for zeros.
  void check_data() const {
    bool const tiled = TIFFIsTiled(file_.get()) != 0;
    char const* const piece = tiled ? "tile" : "strip";
    auto const pieces = tiled ? TIFFNumberOfTiles(file_.get()) : TIFFNumberOfStrips(file_.get());
    auto const size = tiled ? TIFFTileSize64(file_.get()) : TIFFStripSize64(file_.get());
    constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20U;
    if (size == 0 || size > most_bytes) {
      fail(std::string("its ") + piece + "s are of " + std::to_string(size) +
           " bytes, expected at most 64 MiB");
    }
    std::vector<unsigned char> bytes(size);
    for (std::uint32_t i = 0; i < pieces; ++i) {
      auto const expected = tiled ? size : bytes_of_strip(i);
      auto const got =
          TIFFGetStrileByteCount(file_.get(), i) == 0 ? 0
          : tiled ? TIFFReadEncodedTile(file_.get(), i, bytes.data(), static_cast<tmsize_t>(size))
                  : TIFFReadEncodedStrip(file_.get(), i, bytes.data(), static_cast<tmsize_t>(size));
      if (got >= 0 && static_cast<std::uint64_t>(got) == expected) continue;
      fail(std::string("is damaged: ") + piece + " " + std::to_string(i + 1) + " of " +
           std::to_string(pieces) + (got == 0 ? " is empty" : " cannot be decoded") +
           (file_.error().empty() ? "" : ": " + file_.error()));
    }
  }

  // GDAL's tag as text; NaN if it is missing.
  double no_data() const {
    constexpr ttag_t tag = 42113;
    double value = std::numeric_limits<double>::quiet_NaN();
    auto const* const field = TIFFFindField(file_.get(), tag, TIFF_ANY);
    if (field == nullptr) return value;
    char const* text = nullptr;
    std::uint32_t count = 0;
    int const found = TIFFFieldPassCount(field) != 0 ? TIFFGetField(file_.get(), tag, &count, &text)
                                                     : TIFFGetField(file_.get(), tag, &text);
    if (found != 0 && text != nullptr) std::sscanf(text, "%lf", &value);
    return value;
  }

 private:
  // The last one of an image may have fewer rows.
  std::uint64_t bytes_of_strip(std::uint32_t strip) const {
    std::uint32_t rows = 0;
    TIFFGetFieldDefaulted(file_.get(), TIFFTAG_ROWSPERSTRIP, &rows);
    auto const height = static_cast<std::uint32_t>(size(TIFFTAG_IMAGELENGTH));
    rows = std::clamp(rows, 1U, std::max(height, 1U));
    auto const strips = (height + rows - 1) / rows;
    auto const first = strip % std::max(strips, 1U) * rows;
    return TIFFVStripSize64(file_.get(), std::min(rows, height - first));
  }

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

// Integers are read as fractions of the largest value of their type.
double largest_of(OIIO::TypeDesc const& type) {
  unsigned const bits = 8 * static_cast<unsigned>(type.size()) - (type.is_signed() ? 1 : 0);
  return std::ldexp(1.0, static_cast<int>(bits)) - 1.0;
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
  header.no_data = file.no_data();
  int const unit = file.key(VerticalUnitsGeoKey);
  if (unit != 0 && unit != Linear_Meter) fail("its elevations are not in metres");
  return header;
}

}  // namespace

Elevations read_elevations(char const* path) {
  Elevations result;
  auto const& header = result.header;
  {
    Header const file(path);
    result.header = read_header(file);
    if (std::int64_t{header.columns} * header.rows > most_elevations) return result;
    file.check_data();
  }
  auto const input = OIIO::ImageInput::create("tiff");
  OIIO::ImageSpec spec;
  if (!input) fail(OIIO::geterror());
  if (!input->open(path, spec)) fail(input->geterror());
  if (spec.width != header.columns || spec.height != header.rows) {
    fail("it changed while it was being read");
  }
  if (spec.nchannels != 1) {
    fail("it has " + std::to_string(spec.nchannels) + " channels, expected one with elevations");
  }
  auto& elevations = result.elevations;
  elevations.resize(static_cast<std::size_t>(header.columns) *
                    static_cast<std::size_t>(header.rows));
  if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::DOUBLE, elevations.data())) {
    fail(input->geterror());
  }
  if (!spec.format.is_floating_point()) {
    double const largest = largest_of(spec.format);
    for (double& elevation : elevations) elevation = std::round(elevation * largest);
  }
  return result;
}

}  // namespace gpu_shading::decoding
