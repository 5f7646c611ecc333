#include "antialias/aliasing.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace gpu_shading {

void Aliasing::add(Screens::Entry const& screen, SheetInBeam const& sheet) {
  auto const found = std::find_if(screens_.begin(), screens_.end(), [&](AlikeScreens const& each) {
    return alike(*each.first, screen);
  });
  if (found != screens_.end()) {
    ++found->count;
  } else {
    screens_.push_back({&screen, HoleSpectrum(screen, sheet, view_, outline_), 1});
  }
}

void Aliasing::add(SampledRepeats const& repeats) {
  for (Repeat const& repeat : repeats.found) {
    auto const blades = BladeSpectrum::make(repeat, repeats.share, view_, outline_);
    if (!blades) continue;
    bool const known = std::any_of(blades_.begin(), blades_.end(),
                                   [&](BladeSpectrum& other) { return other.merge(*blades); });
    if (!known) blades_.push_back(*blades);
  }
}

Aliasing Aliasing::on_tile(TileMap const& from, TileMap const& to,
                           OutlineSpectrum const& outline) const {
  glm::dmat2 const change = glm::transpose(from.matrix * glm::inverse(to.matrix));
  Aliasing other = *this;
  other.outline_ = outline;
  for (BladeSpectrum& blades : other.blades_) blades.change(change);
  for (AlikeScreens& each : other.screens_) each.holes.change(change, outline);
  return other;
}

double Aliasing::squared_error(TileGrid const& grid, double enough) const {
  double squared = squared_error_of_each(grid, enough);
  for (BladeSpectrum const& blades : blades_) squared += blades.squared_error(grid, enough);
  return squared;
}

double Aliasing::squared_error_of_each(TileGrid const& grid, double enough) const {
  if (screens_.empty()) return 0.0;
  double const negligible = 0.03 * small_enough(grid.rows);
  double sum = 0.0;
  for (int row = 0; row < HoleSpectrum::rows(grid) && sum < enough; ++row) {
    for (AlikeScreens const& each : screens_) {
      sum += each.count * each.holes.squared_error(grid, row, negligible);
    }
  }
  for (AlikeScreens const& each : screens_) {
    sum += each.count * each.holes.squared_error_across_sides(grid, negligible);
  }
  return sum;
}

}  // namespace gpu_shading
