#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// The holes of a perforated sheet: patterns in closed form, as in manufacturers' data, and rasters.
//
// Lengths are in metres. A point in the sheet's plane is (u, v): u along its tile's width and v
// along its height, counterclockwise from u to v as seen from the front. The tile repeats both ways
// from (0, 0).
//
// Constructors throw Error for invalid values; the message begins with the field, as in "pitch is 0
// m, expected more than 0".

namespace gpu_shading {

enum class Hole {
  Round,
  Square,     // sides along u and v
  Slotted,    // long in u, with round ends
  Hexagonal,  // regular, two sides along v, so that webs are uniform at 60 degrees
};

enum class Arrangement {
  Straight,
  Staggered45,  // nearest neighbours at 45 degrees to the rows
  Staggered60,
};

// A perforation as manufacturers describe it. Rows run along u.
struct Perforation {
  Hole hole = Hole::Round;
  Arrangement arrangement = Arrangement::Staggered60;
  double size = 0.0;    // diameter, side, width of a slot, width across a hexagon's flats
  double length = 0.0;  // of a slot from end to end, more than its width; unused for other holes
  double pitch = 0.0;   // between the centres of nearest neighbours, along the stagger where there
                        // is one
  double row_pitch = 0.0;  // Distance between rows if above 0; `pitch` is then along a row,
                           // and staggered rows are offset by half a pitch at any angle, as usual
                           // for slots.
};

// Convex holes on a lattice, one of them centred on (0, 0). Everything is in closed form.
class HolePattern {
 public:
  // Holes must not overlap or touch.
  explicit HolePattern(Perforation const& perforation);

  Perforation const& perforation() const { return perforation_; }
  double width() const { return width_; }  // of the tile, which holds one hole, or two if staggered
  double height() const { return height_; }

  bool is_open(double u, double v) const;

  // Open fraction of the area. Round holes: pi/4 (D/P)^2 straight and at 45 degrees, 0.9069 (D/P)^2
  // at 60.
  double open_fraction() const;

  // Width of the narrowest web between two holes.
  double web() const { return web_; }

  // Length of the longest straight line in a hole; nothing passes at a longer shift.
  double longest_chord() const;

  // Transmittance for a shift: the overlap of a hole's outline with its shifted copy (the lens of
  // two circles, and so on), divided by the area of the sheet per hole.
  double transmittance(double shift_u, double shift_v) const;

 private:
  // The outline of a hole at (0, 0).
  double overlap(double shift_u, double shift_v) const;
  double distance_to_neighbour(double u, double v) const;

  Perforation perforation_;
  double width_ = 0.0;
  double height_ = 0.0;
  int holes_ = 1;
  double web_ = 0.0;
};

// A raster of a tile: row after row along u, the first at v = 0. Each texel holds the opacity of
// its area, 0 (open) .. 65535 (solid), for opacities 0 .. 1. Opacity is interpolated bilinearly
// between the centres of texels, across the tile's edges too. A thresholded tile has opacity 1
// where this value is above the threshold and 0 elsewhere, evaluated in single precision as in a
// shader. Other tiles have fractional opacity, which counts once along a ray: the largest value
// applies.
//
// At most most_texels_a_side texels each way. Value type; copies share the texels.
class OpacityTile {
 public:
  static constexpr int most_texels_a_side = 16384;

  OpacityTile(double width, double height, int columns, int rows,
              std::vector<std::uint16_t> opacity, std::optional<double> threshold = 0.5);

  // From opacities 0 .. 1, rounded to nearest with halves rounded down, so that 0.5 is not above a
  // threshold of 0.5.
  OpacityTile(double width, double height, int columns, int rows, std::vector<float> const& opacity,
              std::optional<double> threshold = 0.5);

  // Rasterises a pattern. Each texel holds its solid fraction or, with a threshold, the solid
  // fraction of an area twice as wide and high about its centre, because only then do interpolated
  // edges coincide with the edges of holes. Both use 256 points per texel. Texels are as close to
  // `texel` in size as a whole number of them in the tile allows.
  OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold = 0.5);

  // The same image over another tile; shares the memory of the texels.
  OpacityTile stretched(double width, double height) const;

  double width() const { return width_; }
  double height() const { return height_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  double texel_width() const { return width_ / columns_; }
  double texel_height() const { return height_ / rows_; }
  std::span<std::uint16_t const> opacity() const { return *opacity_; }
  std::optional<double> threshold() const { return threshold_; }

  // Mean open fraction of the texels, after applying the threshold if there is one.
  double open_fraction() const;

  // Width of the narrowest web between holes or parts of one, from runs of solid texels (above the
  // threshold, or above 0.5 without one) between open texels along rows, columns and diagonals. In
  // each of these directions, 3 % of the runs may be shorter, because stray texels (up to one in
  // 10000) and frayed edges (noise of 0.05 in opacity) are not webs; narrow webs in an equally
  // small part of the tile are ignored too. The result is the shortest direction times cos(22.5
  // degrees), for webs in between, at least two texels, and infinite if there is no web.
  double web() const { return web_; }

  // The size of a typical hole: the mean length of runs of open texels along rows and columns.
  // Infinite if everything is solid or everything is open.
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
