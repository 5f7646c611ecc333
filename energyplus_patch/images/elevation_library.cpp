#include <OpenImageIO/imagebuf.h>
#include <geotiff.h>
#include <geotiffio.h>
#include <geovalues.h>
#include <tiffio.h>
#include <xtiffio.h>

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "host/c_interface.h"
#include "images/image_library.h"

namespace {

struct Close {
  void operator()(TIFF* file) const { XTIFFClose(file); }
  void operator()(GTIF* keys) const { GTIFFree(keys); }
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

// The last error goes to the caller's message, not to standard error; warnings go nowhere.
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
    if (!keys_) fail("has no keys of a GeoTIFF");
  }

  int size(ttag_t tag) const {
    std::uint32_t value = 0;
    if (TIFFGetField(file_.get(), tag, &value) == 0) fail("its size is missing");
    return static_cast<int>(value);
  }

  // 0 where it is not there.
  int key(geokey_t name) const {
    unsigned short value = 0;
    return GTIFKeyGetSHORT(keys_.get(), name, &value, 0, 1) == 1 ? value : 0;
  }

  struct Place {
    double x;
    double y;
  };

  // Of the centre of a cell, counted from the top left one.
  Place centre(double column, double row) const {
    // A raster of points has them at whole numbers, one of areas the cells' corners.
    double const half = key(GTRasterTypeGeoKey) == RasterPixelIsPoint ? 0.0 : 0.5;
    Place place{column + half, row + half};
    if (GTIFImageToPCS(keys_.get(), &place.x, &place.y) == 0) {
      fail("is no GeoTIFF: it does not say where its cells lie");
    }
    return place;
  }

  // GDAL's tag, in text; not a number where it is not there.
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
  std::string error_;
  std::unique_ptr<TIFF, Close> file_;
  std::unique_ptr<GTIF, Close> keys_;
};

// The code of its coordinates in the EPSG's register, 0 where it says none.
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
      fail("its rows do not run east (gdalwarp makes them)");
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
    OIIO::ImageBuf image(path);
    if (!image.read(0, 0, true, OIIO::TypeDesc::DOUBLE)) fail(image.geterror());
    auto const& spec = image.spec();
    if (spec.width != columns || spec.height != rows) fail("it has changed meanwhile");
    if (spec.nchannels != 1) {
      fail("it has " + std::to_string(spec.nchannels) + " channels, expected one, of elevations");
    }
    if (!image.get_pixels(image.roi(), OIIO::TypeDesc::DOUBLE, elevations)) fail(image.geterror());
    // Whole numbers come as shares of their type's largest.
    auto const stored = image.nativespec().format;
    if (stored.is_floating_point()) return;
    unsigned const bits = 8 * static_cast<unsigned>(stored.size()) - (stored.is_signed() ? 1 : 0);
    double const largest = std::ldexp(1.0, static_cast<int>(bits)) - 1.0;
    auto const count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    for (std::size_t i = 0; i < count; ++i) elevations[i] = std::round(elevations[i] * largest);
  });
}
