#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gpu_shading {

// Runs of solid texels between open ones in a raster that repeats both ways.
class SolidRuns {
 public:
  // Texels with the value `solid` or more are solid.
  SolidRuns(std::span<std::uint16_t const> texels, int columns, int rows, std::uint16_t solid);

  // Length of the shortest run in texels, ignoring a fraction of all runs in that direction;
  // infinite if there is none. For diagonals, the shorter of both.
  double shortest_along_rows(double share) const { return shortest(along_rows_, share); }
  double shortest_along_columns(double share) const { return shortest(along_columns_, share); }
  double shortest_along_diagonals(double share) const;

 private:
  // Number of runs of each length.
  using Counts = std::vector<std::size_t>;
  static double shortest(Counts const& counts, double share);

  Counts across_rows(std::span<std::uint16_t const> texels, std::uint16_t solid) const;
  // In the direction of `du` columns, -1, 0 or 1, per row.
  Counts across_columns(std::span<std::uint16_t const> texels, std::uint16_t solid, int du) const;

  std::size_t columns_;
  std::size_t rows_;
  Counts along_rows_;
  Counts along_columns_;
  Counts rising_;
  Counts falling_;
};

}  // namespace gpu_shading
