#pragma once

#include <algorithm>
#include <optional>
namespace gpu_shading {

// The number of pixels per side of a receiver's tile.
//
// Pixels are counted along the edges of shadows: with edges of length L (in sides of the tile),
// each of whose pixels is right or wrong at random, the error of the sunlit fraction is sqrt(L
// side) / side^2. On the rotated pixel grid (TileMap), over 31 scenes of an overhang, fins,
// louvres, slats, neighbours and random quadrilaterals with 40 directions each, compared with exact
// polygon clipping: the error is within sqrt(max(L, 1)) / side^1.5 in 99 % of cases, and 0.22 of
// that in the root mean square, from 32 to 768 pixels. Edges along the receiver's own, which is how
// louvres and overhangs lie, do better if there are many: within (6 sqrt(min(L, 25)) + 0.03 L) /
// side^2 in 98 % of cases, over 2 to 400 louvres, slats and fins and 64 to 512 pixels, except for
// one pair of count and side in 77, in which the distance of the louvres aliased with the pixel
// grid. Where the CPU measures errors, this is where it begins.
class TileSize {
 public:
  // A fixed number of pixels, at least 1.
  static TileSize fixed(int side);
  // The number of pixels, 2^n or 3 x 2^n, that keeps the error of the sunlit fraction within
  // `error` in 99 % of cases, between limits: 64 and 512 at 1e-3, changing with the error to the
  // power of -2/3, at most 4096, and at most `most`. Behind perforated sheets, a tile may have as
  // many as `most`.
  static TileSize for_error(double error, int most);

  // For edges as Detail counts them.
  int side(double along, double across) const;

  // For a crowd of casters that lie at random, whose shadows have this mean area and thickness,
  // with the receiver's rectangle as the unit, and other edges across it, on the CPU. Between the
  // same limits as side(), but up to four times its maximum. Unless the size is fixed.
  //
  // A shadow of area a and thickness h is met by rows of distance d with an error of a sqrt(g(d /
  // h)), where g grows to d / h where rows are far apart, since most miss it, and with a power of
  // about 4 where they are near, as of shapes that taper off. With as many samples lit as dark,
  // where the error is largest, the fraction's error is 0.5 sqrt(a g). Fitted to 8,000 to 1,000,000
  // random leaves, targets of 1e-2 and 1e-3 (tests/bench/embree_peer).
  int side_behind_crowd(double area, double thickness, double other_edges) const;

  // The rows of bits that are as accurate as a tile of so many pixels.
  static int rows_on(int side) {
    return std::max((side + 1) / 2, std::min(side, 96 + side * 3 / 8));
  }

  double error() const { return error_; }  // 0 if the size is fixed
  bool is_fixed() const { return fixed_.has_value(); }

  // With perforated sheets in view, whose holes have edges of their own: at least half of the
  // maximum, were it not limited to 4096.
  int side_with_screens(int side) const { return std::max(side, fixed_ ? 1 : screened_); }

  int least() const { return least_; }
  int most() const { return most_; }
  // Longer edges make no further difference.
  double enough() const { return enough_; }

 private:
  TileSize() = default;

  std::optional<int> fixed_;
  double error_ = 0.0;
  int least_ = 0;
  int most_ = 0;
  int largest_ = 0;  // by any rule
  int screened_ = 0;
  double enough_ = 0.0;
};

}  // namespace gpu_shading
