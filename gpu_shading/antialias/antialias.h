#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "filters/perforation/screen_shading.h"
#include "filters/transmission.h"
#include "geometry/plane_frame.h"
#include "view/tile.h"
#include "view/view.h"

namespace gpu_shading {

// Samples that do not alias with repeating geometry in front of a receiver: blades at equal
// distances, such as louvres and fins, and the holes of perforated sheets. Below, `view` is that of
// the casters in front, on the tile.

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

// The slope of a turn (TileLay) at which each row of samples on a tile runs nearly along blades and
// passes a few of them. Empty if they are few, if their edges are not parallel, or if they are in
// layers at other distances.
std::optional<double> slope_along(SampledRepeats const& blades, PlaneFrame const& frame,
                                  glm::dvec3 const& towards_sun);

// The stretch of the receiver's tile at which its pixels alias least; 1 where nothing repeats.
double stretch_without_aliasing(ViewOnPixels const& view, Scene const& scene,
                                Transmission const& transmission);

// How the CPU uses samples where no perforated sheet is in view.
enum class SampleUse {
  coverage,   // opaque casters cover them
  counting,   // shades are counted over each, which takes longer
  luminance,  // each has a luminance, which takes longest
};

// The grid on which the CPU samples a tile. A row's span costs the same however fine its columns
// are, and its ends are nearly exact with many of them: only the number of rows matters.
// - Coverage: TileSize::rows_on() rows, and 17 times as many columns; some 2,048 on a small tile.
// - Counting: these rows, and 4 times as many columns.
// - Luminance: the tile's pixels.
// - Perforated sheets: nearly as many samples as the tile has pixels.
// Of these, some more or fewer rows, or more columns and fewer rows, are used if they alias less.
TileGrid sample_grid(Tile const& tile, View const& view, ScreensInView const& screens,
                     SampledRepeats const& blades, SampleUse use);

// A grid of about so many rows, however many the blades, on a tile turned by slope_along(). Empty
// if it aliases with them by more than `max_error`, or if their distances are of many kinds.
std::optional<TileGrid> grid_along(SampledRepeats const& blades, View const& view, double slope,
                                   int rows, double max_error);

// Whether the effective transmittance of sheets is too coarse for a tile, because the receiver's
// edges cut rows of holes.
bool edges_cut_rows(Tile const& tile, View const& view, ScreensInView const& screens);

// Whether some ray to a tile passes two of these sheets.
bool any_overlap(Screens const& screens, std::span<int const> numbers, View const& view);

}  // namespace gpu_shading
