#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace gpu_shading::decoding {

// A TIFF with fewer than 8 bits per sample, read by libtiff: OpenImageIO misreads one that is not
// compressed. Rows and columns are as stored.
struct SmallTiff {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int orientation = 1;  // of EXIF
  bool alpha = false;
  std::vector<std::uint32_t> texels;  // red in the lowest byte, then green, blue, alpha
};

// Returns nothing if the file has 8 bits per sample or more. `with_texels`: false for the header
// alone. Throws std::exception.
std::optional<SmallTiff> read_small_tiff(char const* path, bool with_texels);

}  // namespace gpu_shading::decoding
