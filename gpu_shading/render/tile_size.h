#pragma once

#include <algorithm>
#include <optional>

#include "scene/detail.h"

namespace gpu_shading {

// How many pixels a side a receiver's tile gets.
//
// Pixels are counted along the edges of shadows: with edges of the length L (in sides of the tile)
// each of them right or wrong by chance, the sunlit fraction is off by sqrt(L side) / side^2. On
// the lattice as it is turned (TileMap), over 31 scenes of an overhang, fins, louvres, slats,
// neighbours and random quadrilaterals, 40 directions each, against exact polygon clipping: the
// error is within sqrt(max(L, 1)) / side^1.5 for 99 of a hundred, 0.22 of it in the root mean
// square, from 32 to 768 pixels. Edges along the receiver's own, which is how louvres and overhangs
// lie, do better where they are many: within (6 sqrt(min(L, 25)) + 0.03 L) / side^2 for 98 of a
// hundred, over 2 to 400 louvres, slats and fins and 64 to 512 pixels, but for one pair of count
// and side of 77, in which the louvres' distance met the lattice's own.
class TileSize {
 public:
  // Always this many, at least 1.
  static TileSize fixed(int side);
  // As many as keep the error of the sunlit fraction within `error` for 99 of a hundred, of 2^n and
  // 3 x 2^n pixels those between the limits: at 1e-3 64 and 512, and with the error's power of -2/3
  // from there, 4096 at most; `most` where that is less.
  static TileSize for_error(double error, int most);

  int side(Detail const& detail) const;

  // With perforated sheets in view, whose holes have edges of their own: half of the most, if not
  // more already.
  int side_with_screens(int side) const { return std::max(side, fixed_ ? 1 : (most_ + 1) / 2); }

  int least() const { return least_; }
  int most() const { return most_; }
  // Edges longer than this change nothing any more.
  double enough() const { return enough_; }

 private:
  TileSize() = default;

  std::optional<int> fixed_;
  double error_ = 0.0;
  int least_ = 0;
  int most_ = 0;
  double enough_ = 0.0;
};

}  // namespace gpu_shading
