#pragma once

#include <optional>
#include <span>
#include <vector>

// The optics of a perforated sheet: what of the beam passes it, edges of the sheet aside.
//
// Lengths are in metres. A place in the sheet's plane is (u, v): u along its tile's width, v along
// its height, counter-clockwise from u to v as the front face is seen. The tile repeats both ways
// from (0, 0). Directions are theta, the angle of incidence from the normal, 0 .. pi/2, and phi,
// the angle in the plane from u towards v of the beam's projection, both in radians. A beam and its
// reverse pass alike, so that phi and phi + pi are one and both faces have the same transmittance.
//
// Walls are straight and black: a ray passes where every point of its way, (u, v) to (u, v) +
// thickness tan(theta) (cos(phi), sin(phi)), is open. That length is the shift.
//
// Constructors and functions throw Error where what they are given makes no screen; the message
// begins with the field, as in "pitch is 0 m, expected more than 0".

namespace gpu_shading {

enum class Hole {
  Round,
  Square,     // sides along u and v
  Slotted,    // long in u, with round ends
  Hexagonal,  // regular, two of its sides along v, so that at 60 degrees webs are even
};

enum class Arrangement {
  Straight,
  Staggered45,  // nearest neighbours at 45 degrees to the rows
  Staggered60,
};

// What makers publish of a perforation. Rows run along u.
struct Perforation {
  Hole hole = Hole::Round;
  Arrangement arrangement = Arrangement::Staggered60;
  double size = 0.0;    // diameter, side, width of a slot, width across a hexagon's flats
  double length = 0.0;  // of a slot from end to end, more than its width; not of other holes
  double pitch = 0.0;   // between the centres of nearest neighbours, along the stagger where there
                        // is one
  double row_pitch = 0.0;  // Where above 0, rows are this far apart, `pitch` is along a row, and
                           // staggered rows are half a pitch apart, whatever the angle; as slots
                           // are given.
};

// Convex holes on a lattice, one of them with its centre at (0, 0). Everything is in closed form.
class HolePattern {
 public:
  // Holes have to lie apart.
  explicit HolePattern(Perforation const& perforation);

  double width() const { return width_; }  // of the tile: one hole, or two where staggered
  double height() const { return height_; }

  bool is_open(double u, double v) const;

  // Open share of the area. Round: pi/4 (D/P)^2 straight and at 45 degrees, 0.9069 (D/P)^2 at 60.
  double open_fraction() const;

  // The narrowest web between two holes.
  double web() const { return web_; }

  // Length of the longest straight line in a hole: a longer shift lets nothing pass.
  double longest_chord() const;

  // Transmittance for a shift: the area of a hole's outline that its own, shifted, has in common
  // with it (two circles' lens, and so on), over the area of the sheet for each hole.
  double transmittance(double shift_u, double shift_v) const;

 private:
  // Of a hole at (0, 0).
  double overlap(double shift_u, double shift_v) const;
  double distance_to_neighbour(double u, double v) const;

  Perforation perforation_;
  double width_ = 0.0;
  double height_ = 0.0;
  int holes_ = 1;
  double web_ = 0.0;
};

// A raster of a tile: row after row along u, the first at v = 0, each texel the opacity of its
// area, 0 open .. 1 solid. Between texels' centres it is interpolated bilinearly, across the
// tile's edges too. A thresholded tile is 1 where that is above its threshold and 0 elsewhere, as a
// shader does it; one that is not has fractional opacity, which counts once on a ray's way: its
// largest does.
class OpacityTile {
 public:
  OpacityTile(double width, double height, int columns, int rows, std::vector<float> opacity,
              std::optional<double> threshold = 0.5);

  // Each texel the share of it that is solid or, where there is a threshold, of an area twice as
  // wide and high about its centre, since only then an edge interpolated lies where the hole's
  // does: from 256 points in a texel. Texels are as near to `texel` in size as a whole number of
  // them in the tile makes them.
  OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold = 0.5);

  double width() const { return width_; }
  double height() const { return height_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double texel_width() const { return width_ / columns_; }
  double texel_height() const { return height_ / rows_; }
  std::span<float const> opacity() const { return opacity_; }
  std::optional<double> threshold() const { return threshold_; }

  // Mean openness of the texels, each taken against the threshold where there is one.
  double open_fraction() const;

  // The narrowest web, between holes or parts of one: the shortest run of solid texels (above the
  // threshold, or above 0.5 where there is none) between open ones, along rows, columns and
  // diagonals, times cos(22.5 degrees) for webs that lie between those directions. At least two
  // texels; infinite where there is none.
  double web() const;

 private:
  double width_ = 0.0;
  double height_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> opacity_;
  std::optional<double> threshold_;
};

// Layers that stand for a sheet at a shift, front and back counted: 1 + ceil(shift / web), so that
// no ray steps over a web, `most` at most; 0 past the longest way through a hole, where the sheet
// is solid. `web` above 0, shifts from 0. Round, square and hexagonal holes of 64 texels, drawn so,
// are within 2e-3 of the closed form over theta 0 .. 85 degrees, on average 7e-4.
int layers_for(double shift, double web, double longest_chord, int most = 64);

// Share of the beam that `layers` equidistant copies of the tile over the thickness let pass, at
// four rays for each texel: what a renderer of layers draws at twice the tile's resolution. No
// layers: 0.
double layered_transmittance(OpacityTile const& tile, int layers, double shift, double phi);

// tau(theta, phi) of a sheet as a table of 120 directions phi over pi, equal steps of the shift in
// each, linear between them.
//
// From a pattern: the closed form at 512 steps, within 1e-3 of it, 1e-5 for round holes; squares
// end at different shifts from one phi to the next. From a tile: layers a texel apart or more (but
// half a web at most, and a 128th of the tile's shorter side), added one after the other until
// nothing passes, which gives all angles theta of a phi together. With holes of 48 texels that is
// within 4e-3 of the closed form, on average 1e-3, and takes half a second; in general 480 x steps
// x texels interpolations of 1 to 2 ns. A way through the tile that
// does not end (slats) is followed for eight widths and heights of it, and lets as much pass
// farther; near such a direction the table is coarse.
//
// A value: safe to share between threads.
class ScreenTransmittance {
 public:
  // A thickness of 0 is allowed: the open fraction at every angle.
  ScreenTransmittance(HolePattern const& pattern, double thickness);
  ScreenTransmittance(OpacityTile const& tile, double thickness);

  // Angles theta outside 0 .. pi/2 are taken at the nearest end; any phi.
  double operator()(double theta, double phi) const;

  double thickness() const { return thickness_; }
  double open_fraction() const { return values_.front(); }

  // The shift from which nothing passes in any direction phi, within a step; infinite where a way
  // does not end.
  double longest_chord() const { return longest_chord_; }
  // tan(theta) = longest chord / thickness.
  double cut_off() const;

  // The table as a texture: directions() rows, phi from 0 in steps of pi / directions(), which
  // repeat, and steps() columns, the shift from 0 in steps of step().
  static constexpr int directions() { return 120; }
  int steps() const { return steps_; }
  double step() const { return step_; }
  std::span<float const> values() const { return values_; }

 private:
  double at(int direction, double shift) const;

  double thickness_ = 0.0;
  double step_ = 0.0;
  int steps_ = 0;
  double longest_chord_ = 0.0;
  std::vector<float> values_;
};

}  // namespace gpu_shading
