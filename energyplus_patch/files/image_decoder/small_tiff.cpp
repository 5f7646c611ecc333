#include "files/image_decoder/small_tiff.h"

#include <tiffio.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "files/image_decoder/tiff_file.h"

namespace gpu_shading::decoding {
namespace {

// Ends what TIFFRGBAImageBegin() began.
struct End {
  void operator()(TIFFRGBAImage* image) const { TIFFRGBAImageEnd(image); }
};

}  // namespace

std::optional<SmallTiff> read_small_tiff(char const* path, bool with_texels) {
  constexpr std::uint16_t full = 8;
  TiffFile const file(path);
  std::uint16_t bits = 1;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  if (bits >= full) return std::nullopt;
  constexpr std::uint32_t most = 1U << 30U;
  SmallTiff small;
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_ORIENTATION, &orientation);
  small.orientation = orientation;
  if (TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &small.width) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &small.height) == 0 || small.width == 0 ||
      small.height == 0 || small.width > most || small.height > most) {
    throw std::runtime_error("its size is out of range");
  }
  TIFFRGBAImage image{};
  std::array<char, 1024> why{};
  constexpr int stop_on_error = 1;
  if (TIFFRGBAImageBegin(&image, file.get(), stop_on_error, why.data()) == 0) {
    throw std::runtime_error(why.data());
  }
  std::unique_ptr<TIFFRGBAImage, End> const open(&image);
  small.alpha = image.alpha != 0;
  if (!with_texels) return small;
  small.texels.resize(std::size_t{small.width} * small.height);
  image.req_orientation = image.orientation;  // rows and columns as they are stored
  if (TIFFRGBAImageGet(&image, small.texels.data(), small.width, small.height) == 0) {
    throw std::runtime_error(file.error().empty() ? "it is damaged" : file.error());
  }
  return small;
}

}  // namespace gpu_shading::decoding
