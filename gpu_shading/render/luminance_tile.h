#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/convex_area.h"
#include "render/pixel_mask.h"

namespace gpu_shading {

// The luminance of each pixel of a square tile, or of some rows of it.
class LuminanceTile {
 public:
  // All 1, rows from `first_row` to before `end_row`.
  void start(int side, int first_row, int end_row);

  int side() const { return side_; }
  std::span<float> row(int number);

  void multiply(ConvexArea const& area, float by);

  // Calls use(row, first, length) for the pixels of each row that an area has any in.
  template <typename Use>
  void each_span(ConvexArea const& area, Use use) const;

  // Over the lit pixels of a mask of the same rows, one sum a row, each in a fixed order.
  void sum_rows(PixelMask const& lit, std::span<double> sums) const;

 private:
  int side_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;  // a row's, in whole words of a mask
  std::vector<float> pixels_;
};

template <typename Use>
void LuminanceTile::each_span(ConvexArea const& area, Use use) const {
  RowSpans spans;
  int const end_row = std::min(area.end_row, end_row_);
  for (int row = std::max(area.first_row, first_row_); row < end_row; row += RowSpans::rows) {
    find_spans(area, row, side_, spans);
    if (spans.longest == 0) continue;
    int const rows = std::min(RowSpans::rows, end_row - row);
    for (int i = 0; i < rows; ++i) {
      auto const at = static_cast<std::size_t>(i);
      if (spans.length[at] > 0) use(row + i, spans.first[at], spans.length[at]);
    }
  }
}

}  // namespace gpu_shading
