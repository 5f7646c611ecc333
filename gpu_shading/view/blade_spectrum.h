#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "scene/repeat.h"
#include "view/outline_spectrum.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// The frequencies of blades at equal distances, such as louvres or fins, as a view has them, in
// cycles per tile: multiples of one.
class BladeSpectrum {
 public:
  // `share`: of the receiver, behind these blades. Empty for blades in line, end to end,
  // or too close to tell.
  static std::optional<BladeSpectrum> make(Repeat const& repeat, double share, View const& view,
                                           OutlineSpectrum const& outline);

  // Whether the other one's are in step with these over all of the tile; then takes its share.
  bool merge(BladeSpectrum const& other);

  // Upper limit of the squared error of the mean over a grid, or anything above `enough`.
  double squared_error(TileGrid const& grid, double enough) const;

 private:
  BladeSpectrum(glm::dvec2 const& first, double share, OutlineSpectrum const& outline)
      : outline_(outline), first_(first), share_(share) {}

  static constexpr int strongest = 3;
  static constexpr int at_once = 32;

  // Squares of what some multiples of the frequency add to the error, for blades of all of the
  // receiver and without pi. Grid vectors at a distance matter to the strongest multiples alone.
  double near_strong(TileGrid const& grid, int multiple) const;
  double near_weak(TileGrid const& grid, int from) const;  // of `at_once` of them

  OutlineSpectrum outline_;
  glm::dvec2 first_;
  double share_;
};

}  // namespace gpu_shading
