#pragma once

#include <vector>

#include "antialias/antialias.h"
#include "antialias/spectra.h"
#include "filters/perforation/screens.h"
#include "filters/perforation/sheet_in_beam.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// The aliasing of a view's repeating geometry with a grid of samples. The mean of a pattern over a
// grid is wrong by the amplitude of each of the pattern's frequencies times that of the receiver's
// outline, at the frequency's distance from the nearest vector of the grid's reciprocal lattice.
class Aliasing {
 public:
  // `view` is that of the casters in front, on the tile.
  Aliasing(View const& view, OutlineSpectrum const& outline) : view_(view), outline_(outline) {}

  // A screen drawn by its holes.
  void add(Screens::Entry const& screen, SheetInBeam const& sheet);
  void add(SampledRepeats const& repeats);

  // The same on another tile of the receiver. `from`, `to`: the maps of both tiles.
  Aliasing on_tile(TileMap const& from, TileMap const& to, OutlineSpectrum const& outline) const;

  // An error small enough to end the search for a grid of so many rows.
  static double small_enough(int rows) { return 0.015 / rows; }

  bool none() const { return screens_.empty() && blades_.empty(); }
  // Upper bound of the squared error of a grid, or any number above `enough`.
  double squared_error(TileGrid const& grid, double enough) const;

 private:
  struct AlikeScreens {
    Screens::Entry const* first;
    HoleSpectrum holes;
    int count;
  };

  double squared_error_of_each(TileGrid const& grid, double enough) const;

  View const& view_;
  OutlineSpectrum outline_;
  std::vector<AlikeScreens> screens_;
  std::vector<BladeSpectrum> blades_;
};

}  // namespace gpu_shading
