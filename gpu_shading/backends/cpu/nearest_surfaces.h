#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "backends/cpu/surface_pieces.h"
#include "geometry/convex_area.h"
#include "view/pixel_rows.h"

namespace gpu_shading {

// The nearest surface in each pixel of some rows of a square tile, and its depth.
class NearestSurfaces {
 public:
  // None anywhere. Of surfaces whose depths differ by less than `tie` the first to be added has the
  // pixel.
  void start(int side, int first_row, int end_row, double tie) {
    tie_ = tie;
    depths_.start(side, first_row, end_row, std::numeric_limits<double>::infinity());
    numbers_.start(side, first_row, end_row, 0);
  }

  // A piece of a surface whose number is more than 0.
  void add(ConvexArea const& area, DepthPlane const& depth, std::uint32_t number);

  std::span<std::uint32_t> numbers(int row) { return numbers_.row(row); }
  std::span<double> depths(int row) { return depths_.row(row); }

 private:
  double tie_ = 0.0;
  PixelRows<double> depths_;
  PixelRows<std::uint32_t> numbers_;
};

}  // namespace gpu_shading
