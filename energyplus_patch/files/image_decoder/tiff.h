#pragma once

#include <tiffio.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::decoding {

// An open TIFF whose library prints nothing.
class TiffFile {
 public:
  // Throws std::runtime_error.
  explicit TiffFile(char const* path);

  TIFF* get() const { return file_.get(); }

  // The library's last error, or "".
  std::string const& error() const { return *error_; }

 private:
  struct Close {
    void operator()(TIFF* file) const;
  };

  std::unique_ptr<std::string> error_;  // at one address, which the library keeps
  std::unique_ptr<TIFF, Close> file_;
};

class TiffFile;

struct TiffSamples {
  std::vector<double> values;  // row after row
  bool single_precision = false;
};

// Reads the first image of a TIFF with one channel, as GDAL does: the numbers that the file stores,
// neither scaled nor inverted. Integers have 1 to 23, 25 to 32 or 64 bits, floating-point numbers
// 16, 32 or 64.
// Throws std::runtime_error, also if a strip or tile is missing or damaged.
TiffSamples read_samples(TiffFile const& file);

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
