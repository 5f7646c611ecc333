#include "view/aliasing.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <limits>

namespace gpu_shading {

bool Aliasing::AlikeScreens::include(Screens::Entry const& screen) const {
  constexpr double alike = 1e-9;
  return screen.screen == first->screen && glm::length(screen.u - first->u) < alike &&
         glm::length(screen.v - first->v) < alike;
}

void Aliasing::add(Screens::Entry const& screen, SheetInBeam const& sheet) {
  auto const alike = std::find_if(screens_.begin(), screens_.end(),
                                  [&](AlikeScreens const& each) { return each.include(screen); });
  if (alike != screens_.end()) {
    ++alike->count;
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

void Aliasing::overlap() {
  if (!screens_.empty()) first_ = screens_.front().holes.lowest();
}

double Aliasing::squared_error(TileGrid const& grid, double enough) const {
  double squared = squared_error_of_each(grid, enough);
  for (BladeSpectrum const& blades : blades_) squared += blades.squared_error(grid, enough);
  // Each with the first one.
  for (std::size_t k = 0; !first_.empty() && k < screens_.size(); ++k) {
    int const others = k == 0 ? screens_[k].count - 1 : screens_[k].count;
    if (others > 0) squared += others * squared_error_of_pairs(grid, screens_[k].holes, enough);
  }
  return squared;
}

double Aliasing::squared_error_of_each(TileGrid const& grid, double enough) const {
  if (screens_.empty()) return 0.0;
  // Holes have high frequencies too, which are weak: beyond `low`, those that nearly meet matter.
  constexpr int order = 24;
  constexpr int low = 12;
  constexpr double any = std::numeric_limits<double>::infinity();
  constexpr double nearly = 2.0;
  double sum = 0.0;
  for (int row = 0; row <= order && sum < enough; ++row) {
    for (int column = row == 0 ? 1 : -order; column <= order; ++column) {
      glm::dvec2 const vector = grid.reciprocal(column, row);
      double within = any;
      if (std::max(row, std::abs(column)) > low) within = nearly;
      for (auto const& [first, holes, count] : screens_) {
        double const error = holes.error_at(vector, within);
        sum += count * error * error;
      }
    }
  }
  return sum;
}

// Frequencies of two screens add up where a ray passes both.
double Aliasing::squared_error_of_pairs(TileGrid const& grid, HoleSpectrum const& second,
                                        double enough) const {
  constexpr int order = 3;
  constexpr double any = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (HoleSpectrum::Frequency const& frequency : first_) {
    for (int row = -order; row <= order && sum < enough; ++row) {
      for (int column = -order; column <= order; ++column) {
        if (column == 0 && row == 0) continue;
        glm::dvec2 const vector = grid.reciprocal(column, row);
        double const error = frequency.amplitude * second.error_at(vector - frequency.at, any);
        sum += 0.5 * error * error;  // of two that are opposite, each counts
      }
    }
  }
  return sum;
}

}  // namespace gpu_shading
