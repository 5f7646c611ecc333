#pragma once

#include "backends/cpu/coverage.h"
#include "backends/cpu/replicates.h"

namespace gpu_shading {

// Pixels of a tile that opaque casters leave lit, by the samples of a grid.
inline double lit_on_cpu(Coverage const& coverage, Tile const& tile, TileGrid const& grid,
                         View const& in_front, CastersInView const& casters, int threads) {
  SampledView view;
  view.grid = grid;
  view.outline = outline_on(tile, grid);
  view.in_front = in_pixels(in_front, grid);
  RowSums const rows = coverage.rows(view, casters, true, threads);
  return total(rows.lit.front()) * static_cast<double>(tile.counted_pixels) / total(rows.own);
}

}  // namespace gpu_shading
