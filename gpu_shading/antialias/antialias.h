#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "filters/transmission.h"
#include "geometry/plane_frame.h"
#include "scene/turns.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// Samples that do not alias with repeating geometry in front of a receiver, where errors are not
// measured: on a GPU. What repeats are blades at equal distances, such as louvres and fins, and the
// holes of perforated sheets.

// A surface that repeats another one, as louvres, fins and slats do.
struct Repeat {
  glm::dvec3 step{0.0};  // from the other one, m
  glm::dvec3 edge{0.0};  // the longest of its edges, m
  glm::dvec3 side{0.0};  // the other side of a parallelogram with that edge and its area, m
};

// Empty if no surface shortly before it in the scene has the same shape and orientation, but for
// what rounding coordinates to 1e-5 m changes. The step is the mean of up to 1,024.
std::optional<Repeat> repeat_of(Scene const& scene, SurfaceId id);

// The repeats among a sample of the casters in view.
struct SampledRepeats {
  std::vector<Repeat> found;
  double share = 0.0;  // of all casters that each stands for
};

// Empty where casters are few.
SampledRepeats repeats_among(Scene const& scene, std::span<SurfaceId const> casters);

// A view that is sampled at the centres of its tile's pixels; the tile is not stretched.
struct ViewOnPixels {
  SurfaceId receiver;
  PlaneFrame const& frame;
  Tile const& tile;
  glm::dvec3 towards_sun;
  double pixel_area;  // normal to the beam, m2
  std::span<SurfaceId const> casters;
  bool transmits;  // some caster transmits part of the beam
};

// Slopes of rows that run nearly along blades. Each row passes a few of them, so that it meets
// nearly their mean, even if only a part of the row is in the receiver. Empty unless all of a
// sample repeat, at small distances.
std::optional<ReplicateSlopes> slopes_along(SampledRepeats const& blades, PlaneFrame const& frame,
                                            glm::dvec3 const& towards_sun);

// The stretch of the receiver's tile at which its pixels alias least; 1 where nothing repeats.
double stretch_without_aliasing(ViewOnPixels const& view, Scene const& scene,
                                Transmission const& transmission);

// The samples of a crowd of opaque casters on a tile: TileSize::rows_on() rows, and 17 times as
// many columns; some 2,048 on a small tile. Some more or fewer rows, if they alias less. `view` is
// that of the casters in front, on the tile.
TileGrid sample_grid(Tile const& tile, View const& view, SampledRepeats const& blades);

// Whether some ray to a tile passes two of these sheets.
bool any_overlap(Screens const& screens, std::span<int const> numbers, View const& view);

}  // namespace gpu_shading
