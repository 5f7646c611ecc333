#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/convex_area.h"
#include "view/pixel_mask.h"

namespace gpu_shading {

// A value for each pixel of a tile, or of some rows of it, laid out as a PixelMask is: each
// row from a whole word on.
template <typename T>
class PixelRows {
 public:
  // All `value`, rows from `first_row` to before `end_row`.
  void start(int columns, int first_row, int end_row, T value) {
    lay_out(columns, first_row, end_row);
    pixels_.assign(static_cast<std::size_t>(end_row - first_row) * stride_, value);
  }
  // Without values.
  void lay_out(int columns, int first_row, int end_row) {
    constexpr int word = PixelMask::word_bits;
    columns_ = columns;
    first_row_ = first_row;
    end_row_ = end_row;
    stride_ = static_cast<std::size_t>((columns + word - 1) / word) * std::size_t{word};
    pixels_.clear();
  }

  int columns() const { return columns_; }
  std::size_t stride() const { return stride_; }
  std::span<T> row(int number) {
    return {pixels_.data() + static_cast<std::size_t>(number - first_row_) * stride_, stride_};
  }
  // Row after row.
  std::span<T const> pixels() const { return pixels_; }

  // Calls use(row, first, length) for the pixels of each row that an area covers.
  template <typename Use>
  void each_span(ConvexArea const& area, Use use) const;

 private:
  int columns_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;
  std::vector<T> pixels_;
};

template <typename T>
template <typename Use>
void PixelRows<T>::each_span(ConvexArea const& area, Use use) const {
  RowSpans spans;
  int const end_row = std::min(area.end_row, end_row_);
  for (int row = std::max(area.first_row, first_row_); row < end_row; row += RowSpans::most) {
    int const rows = std::min(RowSpans::most, end_row - row);
    find_spans(area, row, rows, columns_, spans);
    if (spans.longest == 0) continue;
    for (int i = 0; i < rows; ++i) {
      auto const at = static_cast<std::size_t>(i);
      if (spans.length[at] > 0) use(row + i, spans.first[at], spans.length[at]);
    }
  }
}

}  // namespace gpu_shading
