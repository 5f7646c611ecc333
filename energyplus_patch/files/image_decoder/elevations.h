#pragma once

#include <cstdint>
#include <vector>

namespace gpu_shading::decoding {

// The positions of a GeoTIFF's cells.
struct ElevationHeader {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::int32_t epsg = 0;  // EPSG code of x and y: 4326, 32633, ...; 0: not stated
  double x = 0.0;         // centre of the first cell of the first row
  double y = 0.0;
  double step_x = 0.0;  // step to the next cell of the row, in the file's units
  double step_y = 0.0;  // step to the next row; negative if the first row is the northernmost
};

inline constexpr std::int32_t max_elevations = 1'000'000;

struct Elevations {
  ElevationHeader header;
  // Rows as in the file, NaN where it has no data; empty if there are too many.
  std::vector<double> elevations;
};

// Elevations are the numbers that the file stores, with GDAL's scale and offset applied. Throws
// std::exception, also if rows do not run east, elevations are not in metres, or there are several
// channels.
Elevations read_elevations(char const* path);

}  // namespace gpu_shading::decoding
