#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "gpu_shading/hole_pattern.h"
#include "gpu_shading/opacity_tile.h"

// The optics of a perforated sheet: the fraction of the beam that passes it, away from its edges.
//
// Lengths and positions in the sheet's plane are as in hole_pattern.h. Directions are theta, the
// angle of incidence from the normal, 0 .. pi/2, and phi, the angle in the plane from u towards v
// of the beam's projection, both in radians. A beam and its reverse pass alike, so phi and phi + pi
// are equivalent and both faces have the same transmittance.
//
// Walls are straight and black: a ray passes if every point of its path, (u, v) to (u, v) +
// thickness tan(theta) (cos(phi), sin(phi)), is open. The length of this displacement is called the
// shift.
//
// Constructors and functions throw Error for invalid values; the message begins with the field, as
// in "thickness is -1 m, expected 0 or more".

namespace gpu_shading {

// tau(theta, phi) of a sheet as a table: 120 directions phi over pi, equal steps of the shift in
// each, and linear interpolation.
//
// From a pattern: the closed form at 512 steps. The table is within 1e-3 of it, and within 1e-5 for
// round holes; squares end at different shifts in neighbouring directions phi.
//
// From a tile: rays from open points, spread evenly over each region, are followed exactly to where
// they meet a solid point. Each region has 4096 rays in each direction, or fewer if that would take
// more than a few seconds, but at least 32; if there are several regions, every fourth direction is
// traced and the others are interpolated linearly. With holes of 40 texels, a thousand rays or more
// give each region within 5e-3 of the closed form. 400 rays, which 1024 regions get, are within
// 1e-2 where a region holds few holes and within 4e-2 at worst where it holds 64. The mean is
// within 2e-3, and 5e-4 on average. Rasters of coarser holes themselves differ more from the closed
// form, by 8e-3 at 10 texels. One region takes a tenth of a second, 512 x 512 texels 0.4 s, and
// larger rasters 3 to 5 s of one core, shared among all cores. Regions take at most 48 MiB.
//
// Rays are followed for 64 thicknesses (89.1 degrees) and at most for eight widths and heights of
// the tile. A path that does not end there (slats, or an equally long hole) passes as much beyond;
// near such a direction the table is coarse. A step is a 64th of the mean path, or longer, up to a
// 16th, if the longest path requires it; beyond its end, the table keeps its last value up to the
// longest chord. A fractional opacity of less than half an 8-bit step counts as 0.
//
// Value type: safe to share between threads.
class ScreenTransmittance {
 public:
  // A thickness of 0 is allowed and gives the open fraction at every angle.
  ScreenTransmittance(HolePattern const& pattern, double thickness);
  ScreenTransmittance(OpacityTile const& tile, double thickness);

  // theta is clamped to 0 .. pi/2; phi may be any angle.
  double operator()(double theta, double phi) const;

  double thickness() const { return thickness_; }
  double open_fraction() const { return values_.front(); }

  // The shift beyond which nothing passes in any direction phi, anywhere, within a step; 0 if
  // nothing passes at all, infinite if a path does not end.
  double longest_chord() const { return longest_chord_; }
  // tan(theta) = longest chord / thickness.
  double cut_off() const;

  // The table as a texture: directions() rows, phi from 0 in steps of pi / directions(), repeating;
  // and steps() columns, the shift from 0 in steps of step().
  static constexpr int directions() { return 120; }
  int steps() const { return steps_; }
  double step() const { return step_; }
  std::span<float const> values() const { return values_; }

  // Equal parts of the tile, across in u and up in v, with different transmittances. Patterns, and
  // tiles of up to 256 texels each way, have one; other tiles have one for every 128 texels,
  // rounded, and at most 32 each way. Readers interpolate bilinearly between the centres of
  // regions, across the tile's edges too.
  int regions_across() const { return regions_across_; }
  int regions_up() const { return regions_up_; }

  // Transmittance of each region for a shift in m, 0 or more, row after row along u, the first row
  // at v = 0, for rays that begin in the region as phi goes from 0 to pi. Interpolated like
  // operator(), which gives the mean. A thickness of 0 gives the values at no shift.
  std::vector<float> at_shift(double shift, double phi) const;
  // The same, interpolated at one position, in tiles, 0 .. 1.
  double at_place(double shift, double phi, glm::dvec2 const& place) const;

 private:
  int regions() const { return regions_across_ * regions_up_; }
  double at(double shift, double phi) const;
  struct Lookup;
  Lookup lookup(double place, double phi) const;
  // Values at a shift of this many steps, if there are several regions.
  std::vector<float> of_regions(double place, double phi) const;

  double thickness_ = 0.0;
  double step_ = 0.0;
  int steps_ = 0;
  double longest_chord_ = 0.0;
  std::vector<float> values_;
  int regions_across_ = 1;
  int regions_up_ = 1;
  int region_directions_ = 0;
  // For several regions: all regions at each step, and all steps in each direction.
  std::vector<float> region_values_;
};

}  // namespace gpu_shading
