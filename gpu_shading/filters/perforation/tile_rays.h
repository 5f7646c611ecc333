#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "geometry/r2_sequence.h"
#include "gpu_shading/opacity_tile.h"

namespace gpu_shading {

// A part of a tile, in metres.
struct Extent {
  double u;
  double v;
  double width;
  double height;
};

// Points n = 0, 1, .. spread evenly over an area (r2_step), from a start that differs
// between regions.
class Places {
 public:
  Places(Extent const& extent, std::size_t region)
      : extent_(extent),
        start_u_(static_cast<double>(region) * std::numbers::phi),
        start_v_(static_cast<double>(region) * std::numbers::sqrt2) {}

  double u(std::size_t n) const {
    return extent_.u + extent_.width * part(start_u_ + static_cast<double>(n) * r2_step.x);
  }
  double v(std::size_t n) const {
    return extent_.v + extent_.height * part(start_v_ + static_cast<double>(n) * r2_step.y);
  }

 private:
  static double part(double value) { return value - std::floor(value); }

  Extent extent_;
  double start_u_;
  double start_v_;
};

// Rays in a tile's plane and the opacity that they meet. A thresholded tile has opacity 0 or 1.
class TileRays {
 public:
  // Keeps a reference to the tile.
  explicit TileRays(OpacityTile const& tile);

  // Conversions between metres and texels.
  struct Direction {
    double along_x;
    double along_y;
    double per_x;
    double per_y;
  };
  Direction direction(double phi) const;

  // A point where opacity rises on a ray's path, and its new value.
  struct Rise {
    double shift;
    float opacity;
  };

  // Above this opacity, nothing passes: half an 8-bit step below solid.
  static constexpr float solid = 1.0F - 0.5F / 255.0F;

  // Opacity at a point of the tile, in m.
  float opacity(double u, double v) const;

  // Finds where opacity exceeds all earlier values on the path from a point that is not solid,
  // until it is solid or the shift reaches `farthest`. Exact for a thresholded tile. Steps are the
  // areas between four centres of texels near solid texels, and blocks of them elsewhere. Returns
  // the number of steps, to account for the time; overwrites `rises`.
  std::size_t follow(double u, double v, Direction const& direction, double farthest,
                     std::vector<Rise>& rises) const;

  // The first solid run on a path from an open point, between two open ones.
  struct Run {
    double before;  // from the point
    double length;
    double after;
  };
  // None if there is none before the shift reaches `farthest`. What is solid or open for longer
  // than `longest` counts as solid from there on. Solid is what is above the tile's threshold or,
  // if it has none, above `level`.
  std::optional<Run> first_run(double u, double v, Direction const& direction, double level,
                               double farthest, double longest) const;

 private:
  class Walk;

  // Blocks of texels with their largest opacity; each level's blocks are twice as wide and high.
  struct Level {
    int size_log2 = 0;
    std::size_t columns = 0;
    std::vector<std::uint16_t> largest;
  };
  void add_blocks();
  void add_level_above(Level const& level);
  // The texels at and after a column and row.
  std::array<double, 4> corners(int column, int row) const;
  float sample(double x, double y) const;  // as a value of texels
  // Go on to where the interpolated value exceeds a limit or falls to it, and whether it does
  // before the shift reaches `farthest`.
  bool rise(Walk& walk, float limit, double farthest) const;
  bool fall(Walk& walk, float limit, double farthest) const;
  double beyond_edge() const;

  OpacityTile const& tile_;
  std::uint16_t const* texels_;
  int columns_;
  int rows_;
  bool thresholded_;
  float max_open_;  // with a threshold, the largest value that is not above it
  std::vector<Level> levels_;
};

}  // namespace gpu_shading
