#pragma once

#include <vector>

#include "gpu_shading/perforation.h"

namespace gpu_shading {

// What of the beam passes the regions of a tile, over directions phi = 0, pi / directions, .. and
// equal steps of the shift.
struct TileTable {
  int regions_across = 1;
  int regions_up = 1;
  int directions = 1;
  int steps = 2;
  double step = 0.0;
  double longest_chord = 0.0;  // 0 where nothing passes at all
  // Regions row after row; of these all at each step; of these all in each direction.
  std::vector<float> values;
};

// As ScreenTransmittance says it. `most_directions` where there is one region, else a part of
// them: most_directions is a multiple of `directions`.
TileTable make_tile_table(OpacityTile const& tile, double thickness, int most_directions);

}  // namespace gpu_shading
