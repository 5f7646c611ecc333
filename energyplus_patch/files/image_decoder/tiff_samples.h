#pragma once

#include <vector>

namespace gpu_shading::decoding {

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

}  // namespace gpu_shading::decoding
