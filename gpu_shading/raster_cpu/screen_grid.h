#pragma once

#include "raster_cpu/screen_shading.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// Samples of a tile behind perforated screens: nearly as many as it has pixels, on a grid with
// which the screens' holes do not alias, of some grids with more columns and fewer rows. `view` is
// that of the casters in front.
TileGrid screen_grid(Tile const& tile, View const& view, ScreensInView const& screens);

}  // namespace gpu_shading
