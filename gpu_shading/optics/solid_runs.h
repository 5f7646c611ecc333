#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gpu_shading {

// Runs of solid texels between open ones in a raster that repeats both ways, and between them the
// open runs, along rows, columns and diagonals. A solid run ends where the interpolated opacity
// falls to the threshold.
class SolidRuns {
 public:
  // Where a raster is cut into open and solid.
  struct Level {
    double threshold;     // as a value of texels
    std::uint16_t solid;  // the least value of a solid texel
  };

  // Fractional opacity, of which the largest value on a path counts, is the mean over thresholds.
  SolidRuns(std::span<std::uint16_t const> texels, int columns, int rows,
            std::span<Level const> levels);

  // The longest step, in texels (or diagonals of them), with which at most the share `stepped_over`
  // of all rays along the direction, of any length, steps over every solid run on its path;
  // infinite if there are no runs. It is the length of a run: where all have one length, none is
  // stepped over. For diagonals, the shorter of both.
  double step_along_rows(double stepped_over) const { return step(along_rows_, stepped_over); }
  double step_along_columns(double stepped_over) const {
    return step(along_columns_, stepped_over);
  }
  double step_along_diagonals(double stepped_over) const;

 private:
  // The runs of about one length.
  struct Runs {
    double shortest = std::numeric_limits<double>::infinity();
    // Sums over the runs, as shares of the raster, of the starts of rays that can step over it:
    // those in the open run before it, or, if that is shorter, those that end in the one after it.
    double starts = 0.0;
    double starts_by_length = 0.0;
  };
  using Lengths = std::vector<Runs>;
  class Line;

  static double step(Lengths const& lengths, double stepped_over);
  void add_along_rows(Level const& level, Lengths& lengths) const;
  // In the direction of `du` columns, -1, 0 or 1, per row.
  void add_across_rows(Level const& level, int du, Lengths& lengths) const;

  std::span<std::uint16_t const> texels_;
  std::size_t columns_;
  std::size_t rows_;
  double weight_;  // of a level
  Lengths along_rows_;
  Lengths along_columns_;
  Lengths rising_;
  Lengths falling_;
};

}  // namespace gpu_shading
