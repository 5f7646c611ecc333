#pragma once

#include <cstddef>
#include <cstdint>
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
  void each_span(ConvexArea const& area, Use use) const {
    gpu_shading::each_span(area, columns_, first_row_, end_row_, use);
  }

 private:
  int columns_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;
  std::vector<T> pixels_;
};

// The luminance of each pixel of a tile, or of some of its rows.
class LuminanceTile : public PixelRows<float> {
 public:
  // All 1.
  void start(int columns, int first_row, int end_row) {
    PixelRows<float>::start(columns, first_row, end_row, 1.0F);
  }

  void multiply(ConvexArea const& area, float by);

  // The sum over some pixels of a word of a mask of the same rows, in a fixed order.
  double sum(std::size_t word, std::uint64_t pixels) const;
};

}  // namespace gpu_shading
