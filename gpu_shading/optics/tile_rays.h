#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu_shading/perforation.h"

namespace gpu_shading {

// Rays in a tile's plane and what they meet on their way. Of a thresholded tile opacity is 0 or 1.
class TileRays {
 public:
  // Refers to the tile.
  explicit TileRays(OpacityTile const& tile);

  // In texels for a metre, and the other way round.
  struct Direction {
    double along_x;
    double along_y;
    double per_x;
    double per_y;
  };
  Direction direction(double phi) const;

  // Where opacity rises on a ray's way, and to what.
  struct Rise {
    double shift;
    float opacity;
  };

  // Above this, nothing is taken to pass: half a step of 8 bits below solid.
  static constexpr float solid = 1.0F - 0.5F / 255.0F;

  // At a point of the tile, m.
  float opacity(double u, double v) const;

  // Where opacity gets larger than all there was before, on the way from a point that is not solid,
  // until it is solid or the shift `farthest`. In steps of a texel where there is something to
  // meet, half the narrowest web or less, and by whole blocks of texels where there is not. Returns
  // how many steps that were, for an account of the time; `rises` is written over.
  std::size_t follow(double u, double v, Direction const& direction, double farthest,
                     std::vector<Rise>& rises) const;

 private:
  class Walk;

  // Blocks of texels by the opacity of the largest, each level's twice as wide and high.
  struct Level {
    int size_log2 = 0;
    std::size_t columns = 0;
    std::vector<std::uint16_t> largest;
  };
  void add_blocks();
  void add_level_above(Level const& level);
  float sample(double x, double y) const;  // as a value of texels

  OpacityTile const& tile_;
  std::uint16_t const* texels_;
  int columns_;
  int rows_;
  bool thresholded_;
  float most_open_;  // with a threshold, the largest value that is not above it
  std::vector<Level> levels_;
};

}  // namespace gpu_shading
