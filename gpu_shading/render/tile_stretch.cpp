#include "render/tile_stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "antialias/aliasing.h"
#include "antialias/repeat.h"
#include "filters/perforation/sheet_in_beam.h"
#include "gpu_shading/perforated_screen.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

void add_sheets(ReceiverView const& view, View const& in_front, Transmission const& transmission,
                Aliasing& aliasing) {
  for (int const number : transmission.screens_among(view.casters)) {
    Screens::Entry const& entry = transmission.screens()[number];
    bool const effect = may_see_effect(entry, view.towards_sun, view.pixel_area());
    SheetInBeam const sheet = sheet_in_beam(entry, view.towards_sun, 1.0, effect);
    double const pixel = 2.0 / view.tile->side * pixel_in_sheet(entry, in_front);
    bool const drawn = sheet.layers != solid_sheet && pixel < static_cast<double>(sheet.blend_to);
    if (drawn && std::isfinite(entry.screen->hole())) aliasing.add(entry, sheet);
  }
}

}  // namespace

double stretch_without_aliasing(ReceiverView const& view, Scene const& scene,
                                Transmission const& transmission) {
  Tile const& tile = *view.tile;
  constexpr int trials = 12;
  constexpr double farthest = 0.1;
  View const in_front = view_in_front(*view.frame, tile.map, view.towards_sun);
  Aliasing aliasing(in_front, OutlineSpectrum(tile.map, *view.frame));
  aliasing.add(repeats_among(scene, view.casters));
  if (view.transmits) add_sheets(view, in_front, transmission, aliasing);
  if (aliasing.none()) return 1.0;
  double const enough = Aliasing::small_enough(tile.side);
  // Where nothing is in step with the pixels, another lattice is no better.
  constexpr double much = 0.25;
  double best = 1.0;
  double least = std::numeric_limits<double>::infinity();
  TileGrid const grid = pixels_of(tile);
  for (int i = 0; i < trials && least > enough * enough; ++i) {
    double const place = std::fmod(i / std::numbers::phi + 0.5, 1.0);
    double const stretch = 1.0 + farthest * (2.0 * place - 1.0);  // 1 at first
    TileMap const map = i == 0 ? tile.map
                               : fit_tile(*view.frame, scene[view.receiver].polygon.outline,
                                          tile.side, {tile.lay.turn, stretch});
    double const squared = aliasing.on_tile(tile.map, map, OutlineSpectrum(map, *view.frame))
                               .squared_error(grid, least);
    if (squared >= least) continue;
    least = i == 0 ? much * squared : squared;
    best = stretch;
  }
  return best;
}

}  // namespace gpu_shading
