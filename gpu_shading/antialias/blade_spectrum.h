#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "antialias/outline_spectrum.h"
#include "antialias/repeat.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// The frequencies of blades at equal distances, such as louvres or fins, as a view has them, in
// cycles per tile: multiples of one.
class BladeSpectrum {
 public:
  // `first`: the lowest frequency. `share`: of the receiver, behind these blades.
  BladeSpectrum(glm::dvec2 const& first, double share, OutlineSpectrum const& outline)
      : outline_(outline), first_(first), share_(share) {}

  // Empty for blades in line, end to end, or too close to tell.
  static std::optional<BladeSpectrum> make(Repeat const& repeat, double share, View const& view,
                                           OutlineSpectrum const& outline);

  // Whether the other one's are in step with these over all of the tile; then takes its share.
  bool merge(BladeSpectrum const& other);

  // The same on a tile of another shape, with its outline. `change`: of frequencies.
  void change(glm::dmat2 const& change, OutlineSpectrum const& outline) {
    first_ = change * first_;
    outline_ = outline;
  }

  // Upper limit of the squared error of the mean over a grid, or anything above `enough`.
  double squared_error(TileGrid const& grid, double enough) const;

 private:
  OutlineSpectrum outline_;
  glm::dvec2 first_;
  double share_;
};

}  // namespace gpu_shading
