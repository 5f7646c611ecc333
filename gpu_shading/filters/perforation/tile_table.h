#pragma once

#include <vector>

#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// The fraction of the beam that passes the regions of a tile, for directions phi = 0, pi /
// directions, .. and equal steps of the shift.
struct TileTable {
  int regions_across = 1;
  int regions_up = 1;
  int directions = 1;
  int steps = 2;
  double step = 0.0;
  double longest_chord = 0.0;  // 0 where nothing passes at all
  // Nested in the order direction, step, region, with regions row after row.
  std::vector<float> values;
};

// As described for ScreenTransmittance. With one region, there are `max_directions`; otherwise
// fewer, of which max_directions is a multiple.
TileTable make_tile_table(OpacityTile const& tile, double thickness, int max_directions);

}  // namespace gpu_shading
