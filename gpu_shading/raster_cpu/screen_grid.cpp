#include "raster_cpu/screen_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gpu_shading/perforated_screen.h"
#include "view/aliasing.h"

namespace gpu_shading {
namespace {

// Of screens whose holes are drawn on a tile with so many pixels a side.
Aliasing aliasing_of(View const& view, ScreensInView const& screens, int side) {
  Aliasing aliasing(view, OutlineSpectrum());
  for (int const number : screens.numbers) {
    Screens::Entry const& screen = (*screens.screens)[number];
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    double const pixel = 2.0 / side * drawn_pixel(screens, screen, view);
    bool const known = sheet.shape != SheetShape::image || std::isfinite(screen.screen->hole());
    if (!known || sheet.layers == solid_sheet || pixel >= static_cast<double>(sheet.blend_to))
      continue;
    aliasing.add(screen, sheet);
  }
  if (screens.overlap) aliasing.overlap();
  return aliasing;
}

// Whether all screens are patterns, in whose plane a ray takes little time.
bool quick(ScreensInView const& screens) {
  return std::all_of(screens.numbers.begin(), screens.numbers.end(), [&](int number) {
    int const layers = screens.sheets[static_cast<std::size_t>(number)].layers;
    return layers == exact_sheet || layers == solid_sheet;
  });
}

}  // namespace

TileGrid screen_grid(Tile const& tile, View const& view, ScreensInView const& screens) {
  // Over three sets of 200 random screens at 1e-3 (tests/bench/aliasing), 0.03 % of the views are
  // then beyond it. More stretch and trials find grids that alias less by the estimate alone.
  constexpr int trials = 12;
  constexpr double stretch = 0.2;
  constexpr double finer = 1.2;
  Aliasing const aliasing = aliasing_of(view, screens, tile.side);
  if (aliasing.none()) return pixels_of(tile);
  double const side = quick(screens) ? finer * tile.side : tile.side;
  double const enough = 0.015 / tile.side;
  TileGrid best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < trials && least > enough * enough; ++i) {
    TileGrid grid;
    double const share = 1.0 - stretch * std::fmod(i / std::numbers::phi, 1.0);
    grid.rows = static_cast<int>(std::lround(side * share));
    grid.width = static_cast<int>(std::lround(side * side / grid.rows)) + i;
    double const squared = aliasing.squared_error(grid, least);
    if (squared >= least) continue;
    least = squared;
    best = grid;
  }
  return best;
}

}  // namespace gpu_shading
