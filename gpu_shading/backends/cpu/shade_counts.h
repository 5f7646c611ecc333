#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_area.h"
#include "view/pixel_mask.h"

namespace gpu_shading {

// How many shades of each transmittance cover each sample of a tile, or of some rows of it: binary
// numbers, one mask per digit, laid out as a PixelMask is. Takes the time of masks, so that it can
// have many times as many samples as a LuminanceTile.
class ShadeCounts {
 public:
  // No shade anywhere; rows from `first_row` to `end_row` (exclusive).
  void start(int columns, int first_row, int end_row);

  // One more shade.
  void add(ConvexArea const& area, float transmittance);

  // Sums of the luminance behind all shades over the sunlit samples of a mask of the same rows, one
  // sum per row.
  void sum_rows(PixelMask const& lit, std::span<double> sums) const;

 private:
  using Words = std::vector<std::uint64_t>;
  struct Kind {
    float transmittance;
    std::vector<Words> digits;  // at least one, the lowest first
  };

  Kind& kind_of(float transmittance);
  // Adds to the digits after the lowest.
  void carry_on(Kind& kind, std::size_t word, std::uint64_t carry) const;

  int columns_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;  // words of a row
  std::size_t words_ = 0;
  std::vector<Kind> kinds_;
};

}  // namespace gpu_shading
