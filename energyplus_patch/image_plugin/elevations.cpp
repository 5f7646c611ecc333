#include <OpenImageIO/imagebuf.h>
#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/c_interface.h"
#include "image_plugin/image_plugin.h"

namespace {

struct Close {
  void operator()(TIFF* file) const { XTIFFClose(file); }
  void operator()(GTIF* keys) const { GTIFFree(keys); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

// The last error goes into the caller's message instead of standard error; warnings are discarded.
int keep_error(TIFF* /*file*/, void* message, char const* /*module*/, char const* format,
               va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  *static_cast<std::string*>(message) = text.data();
  return 1;
}

int keep_quiet(TIFF* /*file*/, void* /*data*/, char const* /*module*/, char const* /*format*/,
               va_list /*arguments*/) {
  return 1;
}

// A GeoTIFF's header.
class Header {
 public:
  explicit Header(char const* path) {
    XTIFFInitialize();
    std::unique_ptr<TIFFOpenOptions, Close> const options(TIFFOpenOptionsAlloc());
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &error_);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
    file_.reset(TIFFOpenExt(path, "r", options.get()));
    if (!file_) fail(error_.empty() ? "is not a TIFF" : error_);
    keys_.reset(GTIFNew(file_.get()));
    if (!keys_) fail("has no GeoTIFF keys");
  }

  int size(ttag_t tag) const {
    std::uint32_t value = 0;
    if (TIFFGetField(file_.get(), tag, &value) == 0) fail("its size is missing");
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
           (error_.empty() ? "" : ": " + error_));
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

  std::string error_;
  std::unique_ptr<TIFF, Close> file_;
  std::unique_ptr<GTIF, Close> keys_;
};

// The EPSG code of its coordinate system, 0 if it states none.
int epsg_of(Header const& header) {
  int const code = header.key(GTModelTypeGeoKey) == ModelTypeGeographic
                       ? header.key(GeographicTypeGeoKey)
                       : header.key(ProjectedCSTypeGeoKey);
  return code == KvUserDefined ? 0 : code;
}

}  // namespace

extern "C" EXPORTED int gpu_shading_probe_elevations(char const* path,
                                                     gpu_shading_elevation_info* info,
                                                     char* message, std::size_t message_size) {
  return guarded(message, message_size, [&] {
    Header const header(path);
    info->columns = header.size(TIFFTAG_IMAGEWIDTH);
    info->rows = header.size(TIFFTAG_IMAGELENGTH);
    auto const first = header.centre(0.0, 0.0);
    auto const right = header.centre(1.0, 0.0);
    auto const below = header.centre(0.0, 1.0);
    if (right.y != first.y || below.x != first.x) {
      fail("its rows do not run east (convert it with gdalwarp)");
    }
    info->x = first.x;
    info->y = first.y;
    info->step_x = right.x - first.x;
    info->step_y = below.y - first.y;
    info->epsg = epsg_of(header);
    info->no_data = header.no_data();
    int const unit = header.key(VerticalUnitsGeoKey);
    if (unit != 0 && unit != Linear_Meter) fail("its elevations are not in metres");
  });
}

extern "C" EXPORTED int gpu_shading_read_elevations(char const* path, int columns, int rows,
                                                    double* elevations, char* message,
                                                    std::size_t message_size) {
  return guarded(message, message_size, [&] {
    Header(path).check_data();
    OIIO::ImageBuf image(path);
    if (!image.read(0, 0, true, OIIO::TypeDesc::DOUBLE)) fail(image.geterror());
    auto const& spec = image.spec();
    if (spec.width != columns || spec.height != rows) fail("it changed while it was being read");
    if (spec.nchannels != 1) {
      fail("it has " + std::to_string(spec.nchannels) + " channels, expected one with elevations");
    }
    if (!image.get_pixels(image.roi(), OIIO::TypeDesc::DOUBLE, elevations)) fail(image.geterror());
    // Integers are read as fractions of the largest value of their type.
    auto const stored = image.nativespec().format;
    if (stored.is_floating_point()) return;
    unsigned const bits = 8 * static_cast<unsigned>(stored.size()) - (stored.is_signed() ? 1 : 0);
    double const largest = std::ldexp(1.0, static_cast<int>(bits)) - 1.0;
    auto const count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    for (std::size_t i = 0; i < count; ++i) elevations[i] = std::round(elevations[i] * largest);
  });
}
