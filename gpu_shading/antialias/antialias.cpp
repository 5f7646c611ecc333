#include "antialias/antialias.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "antialias/aliasing.h"
#include "gpu_shading/perforated_screen.h"
#include "view/tile_size.h"

namespace gpu_shading {
namespace {

// Whether a sheet has holes, of a known size, which those of an image may not have.
bool has_known_holes(Screens::Entry const& screen, SheetInBeam const& sheet) {
  return sheet.layers != solid_sheet && std::isfinite(screen.screen->hole());
}

void add_sheets(ViewOnPixels const& view, View const& in_front, Transmission const& transmission,
                Aliasing& aliasing) {
  for (int const number : transmission.screens_among(view.casters)) {
    Screens::Entry const& screen = transmission.screens()[number];
    bool const effect = may_see_effect(screen, view.towards_sun, view.pixel_area);
    SheetInBeam const sheet = sheet_in_beam(screen, view.towards_sun, 1.0, effect);
    double const pixel = 2.0 / view.tile.side * pixel_in_sheet(screen, in_front);
    bool const drawn = pixel < static_cast<double>(sheet.blend_to);
    if (drawn && has_known_holes(screen, sheet)) aliasing.add(screen, sheet);
  }
}

void add_sheets(Tile const& tile, View const& view, ScreensInView const& screens,
                Aliasing& aliasing) {
  for (int const number : screens.numbers) {
    Screens::Entry const& screen = (*screens.screens)[number];
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    if (!has_known_holes(screen, sheet)) continue;
    double const pixel = 2.0 / tile.side * drawn_pixel(screens, screen, view);
    if (pixel < static_cast<double>(sheet.blend_to)) {
      aliasing.add(screen, sheet);
    } else if (screens.by_rows && sheet.blend_from > 0.0F) {
      aliasing.add_rows(screen, sheet);
    }
  }
  if (screens.overlap) aliasing.overlap();
}

// Whether all sheets are patterns, in whose plane a ray takes little time.
bool quick(ScreensInView const& screens) {
  return std::all_of(screens.numbers.begin(), screens.numbers.end(), [&](int number) {
    int const layers = screens.sheets[static_cast<std::size_t>(number)].layers;
    return layers == exact_sheet || layers == solid_sheet;
  });
}

// Searches candidates spread by the golden ratio: the first that aliases little enough for so many
// rows, or else the one that aliases least. Calls squared_error_of(candidate, limit), whose answer
// may be anything above `limit` where it is above. The first candidate is kept unless another has
// less than this share of its squared error.
template <typename Candidate, typename CandidateOf, typename SquaredErrorOf>
Candidate least_aliasing(int rows, double share_of_first, CandidateOf candidate_of,
                         SquaredErrorOf squared_error_of) {
  constexpr int trials = 12;
  double const enough = Aliasing::small_enough(rows);
  Candidate best = candidate_of(0);
  double least = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < trials && least > enough * enough; ++trial) {
    Candidate const candidate = candidate_of(trial);
    double const squared = squared_error_of(candidate, least);
    if (squared >= least) continue;
    least = trial == 0 ? share_of_first * squared : squared;
    best = candidate;
  }
  return best;
}

TileGrid least_aliasing_grid(Aliasing const& aliasing, int rows, auto grid_of) {
  return least_aliasing<TileGrid>(rows, 1.0, grid_of, [&](TileGrid const& grid, double limit) {
    return aliasing.squared_error(grid, limit);
  });
}

// Factors within a tenth of 1, spread by the golden ratio; the first is 1.
double golden_stretch(int trial) {
  constexpr double farthest = 0.1;
  double const position = std::fmod(trial / std::numbers::phi + 0.5, 1.0);
  return 1.0 + farthest * (2.0 * position - 1.0);
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

// Where neither blades nor holes are known.
TileGrid usual_grid(Tile const& tile, SampleUse use) {
  if (use == SampleUse::luminance) return pixels_of(tile);
  int const rows = TileSize::rows_on(tile.side);
  if (use == SampleUse::counting) return golden_grid(rows, 4, tile.lay.slope);
  // As fine on small tiles, where casters of a crowd may be much smaller than a row's height.
  constexpr int large = 128;
  int const columns_a_row = tile.side < large ? 2048 / rows : 17;
  return golden_grid(rows, columns_a_row, tile.lay.slope);
}

TileGrid grid_for_blades(TileGrid const& grid, Aliasing const& aliasing) {
  return least_aliasing_grid(aliasing, grid.rows, [&](int trial) {
    TileGrid other = grid;
    other.rows = static_cast<int>(std::lround(grid.rows * golden_stretch(trial)));
    other.width = grid.width / grid.rows * other.rows;
    return other;
  });
}

TileGrid grid_for_sheets(Tile const& tile, ScreensInView const& screens, Aliasing const& aliasing) {
  // Over six sets of 200 random screens at 1e-3 (tests/bench/aliasing), 0.02 % of the views are
  // then beyond it. More stretch and trials find grids that alias less by the estimate alone.
  constexpr double stretch = 0.2;
  constexpr double finer = 1.2;
  double const side = quick(screens) ? finer * tile.side : tile.side;
  return least_aliasing_grid(aliasing, tile.side, [&](int trial) {
    double const share = 1.0 - stretch * std::fmod(trial / std::numbers::phi, 1.0);
    TileGrid grid;
    grid.rows = static_cast<int>(std::lround(side * share));
    grid.width = static_cast<int>(std::lround(side * side / grid.rows)) + trial;
    return grid;
  });
}

}  // namespace

double stretch_without_aliasing(ViewOnPixels const& view, Scene const& scene,
                                Transmission const& transmission) {
  Tile const& tile = view.tile;
  View const in_front = view_in_front(view.frame, tile.map, view.towards_sun);
  Aliasing aliasing(in_front, OutlineSpectrum(tile.map, view.frame));
  aliasing.add(repeats_among(scene, view.casters));
  if (view.transmits) add_sheets(view, in_front, transmission, aliasing);
  if (aliasing.none()) return 1.0;
  TileGrid const grid = pixels_of(tile);
  // Where nothing is in step with the pixels, another lattice is no better.
  constexpr double share_of_first = 0.25;
  return least_aliasing<double>(
      tile.side, share_of_first, golden_stretch, [&](double stretch, double limit) {
        TileMap const map = stretch == 1.0
                                ? tile.map
                                : fit_tile(view.frame, scene[view.receiver].polygon.outline,
                                           tile.side, {tile.lay.slope, stretch});
        return aliasing.on_tile(tile.map, map, OutlineSpectrum(map, view.frame))
            .squared_error(grid, limit);
      });
}

TileGrid sample_grid(Tile const& tile, View const& view, ScreensInView const& screens,
                     SampledRepeats const& blades, SampleUse use) {
  Aliasing aliasing(view, OutlineSpectrum(tile.lay.slope));
  aliasing.add(blades);
  if (!screens.numbers.empty()) {
    add_sheets(tile, view, screens, aliasing);
    return aliasing.none() ? pixels_of(tile) : grid_for_sheets(tile, screens, aliasing);
  }
  TileGrid const usual = usual_grid(tile, use);
  return aliasing.none() ? usual : grid_for_blades(usual, aliasing);
}

std::optional<TileGrid> grid_along(SampledRepeats const& blades, View const& view, double slope,
                                   int rows, double max_error) {
  constexpr std::size_t max_kinds = 6;
  // Blades run along the rows, so that columns need not be fine.
  int const columns_a_row = std::clamp(8192 / rows, 1, 9);
  Aliasing aliasing(view, OutlineSpectrum(slope));
  aliasing.add(blades);
  if (aliasing.none() || aliasing.kinds_of_blades() > max_kinds) return std::nullopt;
  double const squared = max_error * max_error;
  // Twice as many rows are still fewer than those of other tiles.
  for (double const more : {1.0, 1.5, 2.25}) {
    int const trial = static_cast<int>(more * rows);
    TileGrid const grid = grid_for_blades(golden_grid(trial, columns_a_row, slope), aliasing);
    if (aliasing.squared_error(grid, squared) <= squared) return grid;
  }
  return std::nullopt;
}

bool edges_cut_rows(Tile const& tile, View const& view, ScreensInView const& screens) {
  // About half of the error for which a tile has so many pixels (TileSize).
  double const max_error = 2.0 * std::pow(tile.side, -1.5);
  Screens::Entry const* last = nullptr;
  return std::any_of(screens.numbers.begin(), screens.numbers.end(), [&](int number) {
    Screens::Entry const& screen = (*screens.screens)[number];
    SheetInBeam const& sheet = screens.sheets[static_cast<std::size_t>(number)];
    double const pixel = 2.0 / tile.side * drawn_pixel(screens, screen, view);
    bool const too_large = sheet.blend_from > 0.0F && pixel > static_cast<double>(sheet.blend_from);
    if (!too_large || sheet.layers == solid_sheet || sheet.shape == SheetShape::image) return false;
    if (last != nullptr && alike(*last, screen)) return false;
    last = &screen;
    HoleSpectrum const holes(screen, sheet, view, OutlineSpectrum(tile.lay.slope));
    return holes.squared_error_of_effect() > max_error * max_error;
  });
}

}  // namespace gpu_shading
