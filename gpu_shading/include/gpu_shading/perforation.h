#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// Where the holes of a perforated sheet are: closed forms of what makers publish, and rasters.
//
// Lengths are in metres. A place in the sheet's plane is (u, v): u along its tile's width, v along
// its height, counter-clockwise from u to v as the front face is seen. The tile repeats both ways
// from (0, 0).
//
// Constructors throw Error where what they are given makes no screen; the message begins with the
// field, as in "pitch is 0 m, expected more than 0".

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

  Perforation const& perforation() const { return perforation_; }
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
// area, 0 open .. 65535 solid, which is opacity 0 .. 1. Between texels' centres it is interpolated
// bilinearly, across the tile's edges too. A thresholded tile is 1 where that is above its
// threshold and 0 elsewhere, as a shader does it, in floats; one that is not has fractional
// opacity, which counts once on a ray's way: its largest does.
//
// At most most_texels_a_side texels each way. A value; copies share the texels.
class OpacityTile {
 public:
  static constexpr int most_texels_a_side = 16384;

  OpacityTile(double width, double height, int columns, int rows,
              std::vector<std::uint16_t> opacity, std::optional<double> threshold = 0.5);

  // Opacity 0 .. 1, rounded to the nearest, halves down, so that 0.5 is not above a threshold of
  // 0.5.
  OpacityTile(double width, double height, int columns, int rows, std::vector<float> const& opacity,
              std::optional<double> threshold = 0.5);

  // Each texel the share of it that is solid or, where there is a threshold, of an area twice as
  // wide and high about its centre, since only then an edge interpolated lies where the hole's
  // does: from 256 points in a texel. Texels are as near to `texel` in size as a whole number of
  // them in the tile makes them.
  OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold = 0.5);

  // The same image over another tile, which shares its memory.
  OpacityTile stretched(double width, double height) const;

  double width() const { return width_; }
  double height() const { return height_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double texel_width() const { return width_ / columns_; }
  double texel_height() const { return height_ / rows_; }
  std::span<std::uint16_t const> opacity() const { return *opacity_; }
  std::optional<double> threshold() const { return threshold_; }

  // Mean openness of the texels, each taken against the threshold where there is one.
  double open_fraction() const;

  // The narrowest web, between holes or parts of one: from runs of solid texels (above the
  // threshold, or above 0.5 where there is none) between open ones, along rows, columns and
  // diagonals. In each of these directions 3 % of the runs may be shorter, since texels gone astray
  // (up to one in 10000) and frayed edges (noise of 0.05 in opacity) make no web; so may narrow
  // webs in as small a part of the tile. Then the shortest direction, times cos(22.5 degrees) for
  // webs that lie between. At least two texels; infinite where there is none.
  double web() const { return web_; }

  // The size of a typical hole: the mean length of runs of open texels along rows and columns.
  // Infinite where nothing or everything is open.
  double hole() const;

 private:
  void find_web();

  double width_ = 0.0;
  double height_ = 0.0;
  int columns_ = 0;
  int rows_ = 0;
  std::shared_ptr<std::vector<std::uint16_t> const> opacity_;
  std::optional<double> threshold_;
  double web_ = 0.0;
};

}  // namespace gpu_shading
