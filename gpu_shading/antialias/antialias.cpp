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

TileGrid sample_grid(Tile const& tile, View const& view, SampledRepeats const& blades) {
  int const rows = TileSize::rows_on(tile.side);
  // As fine on small tiles, where casters of a crowd may be much smaller than a row's height.
  constexpr int large = 128;
  int const columns_a_row = tile.side < large ? 2048 / rows : 17;
  TileGrid const usual = golden_grid(rows, columns_a_row, tile.lay.slope);
  Aliasing aliasing(view, OutlineSpectrum(tile.lay.slope));
  aliasing.add(blades);
  if (aliasing.none()) return usual;
  auto const grid_of = [&](int trial) {
    TileGrid other = usual;
    other.rows = static_cast<int>(std::lround(rows * golden_stretch(trial)));
    other.width = columns_a_row * other.rows;
    return other;
  };
  return least_aliasing<TileGrid>(rows, 1.0, grid_of, [&](TileGrid const& grid, double limit) {
    return aliasing.squared_error(grid, limit);
  });
}

}  // namespace gpu_shading
