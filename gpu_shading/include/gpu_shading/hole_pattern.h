#pragma once

// The holes of a perforated sheet in closed form, as in manufacturers' data.
//
// Lengths are in metres. A point in the sheet's plane is (u, v): u along its tile's width and v
// along its height, counterclockwise from u to v as seen from the front. The tile repeats both ways
// from (0, 0).
//
// Constructors throw Error for invalid values; the message begins with the field, as in "pitch is 0
// m, expected 1e-06 to 100000".

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

}  // namespace gpu_shading
