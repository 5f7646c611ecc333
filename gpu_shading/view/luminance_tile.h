#pragma once

#include <span>

#include "geometry/convex_area.h"
#include "view/pixel_mask.h"
#include "view/pixel_rows.h"

namespace gpu_shading {

// The luminance of each pixel of a tile, or of some of its rows.
class LuminanceTile : public PixelRows<float> {
 public:
  // All 1.
  void start(int columns, int first_row, int end_row) {
    PixelRows<float>::start(columns, first_row, end_row, 1.0F);
  }

  void multiply(ConvexArea const& area, float by);

  // Sums over the sunlit pixels of a mask of the same rows, one sum per row, each in a fixed order.
  void sum_rows(PixelMask const& lit, std::span<double> sums) const;
};

}  // namespace gpu_shading
