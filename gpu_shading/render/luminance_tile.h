#pragma once

#include <vector>

#include "render/convex_area.h"
#include "render/pixel_mask.h"

namespace gpu_shading {

// The luminance of each pixel of a square tile.
class LuminanceTile {
 public:
  // All 1.
  void start(int side);

  void multiply(ConvexArea const& area, float by);

  // Over the lit pixels of a mask of all rows, in a fixed order.
  double sum(PixelMask const& lit) const;

 private:
  int side_ = 0;
  std::size_t stride_ = 0;  // a row's, in whole words of a mask
  std::vector<float> pixels_;
};

}  // namespace gpu_shading
