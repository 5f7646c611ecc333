#pragma once

#include "antialias/repeat.h"
#include "filters/perforation/screen_shading.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// The CPU samples a tile on a grid of its own, on which what is in front of the receiver aliases
// little. A row's span costs the same however fine its columns are, and its ends are nearly exact
// with many of them: what matters is the number of rows.

// For opaque casters: as many rows as a small tile has pixels, down to half as many on a large one,
// and 9 or 17 times as many columns.
TileGrid fine_grid(Tile const& tile);

// For shades that are counted over each sample, which takes longer than covering: the rows of the
// fine grid, and 4 times as many columns.
TileGrid counting_grid(Tile const& tile);

// `grid`, or one with some more or fewer rows, on which blades alias less. `view` is that of the
// casters in front, on the tile.
TileGrid grid_for_blades(TileGrid const& grid, Tile const& tile, View const& view,
                         SampledRepeats const& blades);

// Whether the effective transmittance of screens is too coarse for a tile, because the receiver's
// edges cut rows of holes. `view` is that of the casters in front.
bool edges_cut_rows(Tile const& tile, View const& view, ScreensInView const& screens);

// Samples of a tile behind perforated screens: nearly as many as it has pixels, on a grid with
// which the screens' holes and blades do not alias, of some grids with more columns and fewer rows.
TileGrid grid_for_screens(Tile const& tile, View const& view, ScreensInView const& screens,
                          SampledRepeats const& blades);

}  // namespace gpu_shading
