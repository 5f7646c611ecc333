#include "antialias/sample_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "antialias/aliasing.h"
#include "antialias/hole_spectrum.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {
namespace {

// Of screens whose holes are drawn on a tile with so many pixels a side.
Aliasing aliasing_of(Tile const& tile, View const& view, ScreensInView const& screens,
                     SampledRepeats const& blades) {
  Aliasing aliasing(view, OutlineSpectrum(tile.lay.slope()));
  aliasing.add(blades);
  for (int const number : screens.numbers) {
    Screens::Entry const& screen = (*screens.screens)[number];
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    double const pixel = 2.0 / tile.side * drawn_pixel(screens, screen, view);
    bool const known = sheet.shape != SheetShape::image || std::isfinite(screen.screen->hole());
    if (!known || sheet.layers == solid_sheet) continue;
    if (pixel < static_cast<double>(sheet.blend_to)) {
      aliasing.add(screen, sheet);
    } else if (screens.by_rows && sheet.blend_from > 0.0F) {
      aliasing.add_rows(screen, sheet);
    }
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

// The first grid that aliases little enough for so many rows, or else the one that does least.
template <typename GridOf>
TileGrid least_aliasing(Aliasing const& aliasing, int rows, GridOf grid_of) {
  constexpr int trials = 12;
  double const enough = Aliasing::small_enough(rows);
  TileGrid best = grid_of(0);
  double least = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < trials && least > enough * enough; ++trial) {
    TileGrid const grid = grid_of(trial);
    double const squared = aliasing.squared_error(grid, least);
    if (squared >= least) continue;
    least = squared;
    best = grid;
  }
  return best;
}

// Many equal louvres or fins at equal distances alias with a lattice of samples if a vector of its
// reciprocal lattice lies along their normal. That of louvres has the slope -1 / s in a tile that
// is turned by the slope s. With k columns to a row, a vector (m, n) misses it by the distance of
// m (k / s + shear) from a whole number, which the shear makes that of m / phi, the largest for all
// m.
TileGrid golden_grid(int rows, int columns_a_row, double slope) {
  double const missed = -columns_a_row / slope;
  auto const part = [](double value) { return value - std::floor(value); };
  return {columns_a_row * rows, rows, std::min(part(missed + golden), part(missed - golden))};
}

}  // namespace

TileGrid fine_grid(Tile const& tile) {
  constexpr int large = 128;  // smaller tiles have too few edges to alias with 9 columns to a row
  int const rows = std::max((tile.side + 1) / 2, std::min(tile.side, 96 + tile.side * 3 / 8));
  return golden_grid(rows, tile.side < large ? 9 : 17, tile.lay.slope());
}

TileGrid counting_grid(Tile const& tile) {
  return golden_grid(fine_grid(tile).rows, 4, tile.lay.slope());
}

TileGrid grid_for_blades(TileGrid const& grid, Tile const& tile, View const& view,
                         SampledRepeats const& blades) {
  constexpr double farthest = 0.1;
  Aliasing aliasing(view, OutlineSpectrum(tile.lay.slope()));
  aliasing.add(blades);
  if (aliasing.none()) return grid;
  return least_aliasing(aliasing, grid.rows, [&](int trial) {
    double const place = std::fmod(trial / std::numbers::phi + 0.5, 1.0);
    double const stretch = 1.0 + farthest * (2.0 * place - 1.0);  // 1 at first
    TileGrid other = grid;
    other.rows = static_cast<int>(std::lround(grid.rows * stretch));
    other.width = grid.width / grid.rows * other.rows;
    return other;
  });
}

bool edges_cut_rows(Tile const& tile, View const& view, ScreensInView const& screens) {
  // About half of the error for which a tile has so many pixels (TileSize).
  double const most = 2.0 * std::pow(tile.side, -1.5);
  Screens::Entry const* last = nullptr;
  return std::any_of(screens.numbers.begin(), screens.numbers.end(), [&](int number) {
    Screens::Entry const& screen = (*screens.screens)[number];
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    double const pixel = 2.0 / tile.side * drawn_pixel(screens, screen, view);
    bool const too_large = sheet.blend_from > 0.0F && pixel > static_cast<double>(sheet.blend_from);
    if (!too_large || sheet.layers == solid_sheet || sheet.shape == SheetShape::image) return false;
    if (last != nullptr && alike(*last, screen)) return false;
    last = &screen;
    HoleSpectrum const holes(screen, sheet, view, OutlineSpectrum(tile.lay.slope()));
    return holes.squared_error_of_effect() > most * most;
  });
}

TileGrid grid_for_screens(Tile const& tile, View const& view, ScreensInView const& screens,
                          SampledRepeats const& blades) {
  // Over six sets of 200 random screens at 1e-3 (tests/bench/aliasing), 0.02 % of the views are
  // then beyond it. More stretch and trials find grids that alias less by the estimate alone.
  constexpr double stretch = 0.2;
  constexpr double finer = 1.2;
  Aliasing const aliasing = aliasing_of(tile, view, screens, blades);
  if (aliasing.none()) return pixels_of(tile);
  double const side = quick(screens) ? finer * tile.side : tile.side;
  return least_aliasing(aliasing, tile.side, [&](int trial) {
    double const share = 1.0 - stretch * std::fmod(trial / std::numbers::phi, 1.0);
    TileGrid grid;
    grid.rows = static_cast<int>(std::lround(side * share));
    grid.width = static_cast<int>(std::lround(side * side / grid.rows)) + trial;
    return grid;
  });
}

}  // namespace gpu_shading
