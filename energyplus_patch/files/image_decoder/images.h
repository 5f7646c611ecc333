#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gpu_shading::decoding {

// Of the picture as displayed: turned as its EXIF orientation says, and all of the display
// window.
struct ImageHeader {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t channels = 0;
  std::int32_t alpha = 0;  // 1: it has an alpha channel
};

struct ImageFile {
  char const* path;            // what is opened
  std::filesystem::path name;  // what the user calls it
  bool any = false;            // in any format
};

inline constexpr std::int64_t max_texels_per_side = 16384;
inline constexpr std::int64_t max_texels = max_texels_per_side * max_texels_per_side;
// Images of so many are decoded as soon as their header is wanted: a start of the program takes
// longer.
inline constexpr std::int64_t few_texels = std::int64_t{1} << 22U;

// Opacity: alpha, or luminance as stored if there is no alpha, 0 .. 65535 for 0 .. 1, clamped, with
// rows from the BOTTOM; 0 in a display window beyond the data window. Empty if the image has more
// than `max_texels_wanted` texels.
struct Image {
  ImageHeader header;
  std::vector<std::uint16_t> opacity;
};

// Throws std::exception, also if a texel is not a number.
Image read_image(ImageFile const& file, std::int64_t max_texels_wanted);

}  // namespace gpu_shading::decoding
