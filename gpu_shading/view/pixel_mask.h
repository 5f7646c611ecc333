#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex_area.h"

namespace gpu_shading {

// Calls use(row, rows, spans) for some rows after another, from `first_row` to `end_row`
// (exclusive), where an area covers columns up to `columns`. Inlined, because a call for each span
// shows in the time of views behind shades.
template <typename Use>
[[gnu::always_inline]] inline void each_rows_of_spans(ConvexArea const& area, int columns,
                                                      int first_row, int end_row, Use use) {
  RowSpans spans;
  int const end = std::min(area.end_row, end_row);
  for (int row = std::max(area.first_row, first_row); row < end; row += RowSpans::most) {
    int const rows = std::min(RowSpans::most, end - row);
    find_spans(area, row, rows, columns, spans);
    if (spans.longest > 0) use(row, rows, spans);
  }
}

// Calls use(row, first, length) for the columns of each of these rows.
template <typename Use>
[[gnu::always_inline]] inline void each_span(ConvexArea const& area, int columns, int first_row,
                                             int end_row, Use use) {
  each_rows_of_spans(area, columns, first_row, end_row,
                     [&](int row, int rows, RowSpans const& spans) {
                       for (int i = 0; i < rows; ++i) {
                         auto const at = static_cast<std::size_t>(i);
                         if (spans.length[at] > 0) use(row + i, spans.first[at], spans.length[at]);
                       }
                     });
}

// Counts bits that are set in both, word by word, up to the shorter length.
std::uint64_t count_common(std::span<std::uint64_t const> a, std::span<std::uint64_t const> b);

// The sunlit pixels of a tile or of some of its rows, one bit each. A pixel's position is its
// centre.
class PixelMask {
 public:
  static constexpr int word_bits = 64;

  // All dark; rows from `first_row` to `end_row` (exclusive).
  void start(int columns, int first_row, int end_row);

  void light(ConvexArea const& area);
  void darken(ConvexArea const& area);

  std::uint64_t lit() const { return count_common(words(), words()); }
  // Adds the number of lit pixels of each row.
  void count_rows(std::span<double> counts) const;
  // Whether some pixel of a rectangle is lit; ends are exclusive. `first_row` and the rest must be
  // within the mask.
  bool any_lit(int first_row, int end_row, int first_column, int end_column) const;

  int columns() const { return columns_; }
  int first_row() const { return first_row_; }
  int end_row() const { return end_row_; }

  // Row after row, each beginning with a new word; the lowest bit of a word is the leftmost pixel.
  std::span<std::uint64_t> words() { return {words_.data(), words_.size() - spare}; }
  std::span<std::uint64_t const> words() const { return {words_.data(), words_.size() - spare}; }
  // The word with a row's pixel.
  std::uint64_t word(int row, int column) const {
    return words_[static_cast<std::size_t>(row - first_row_) * stride_ +
                  static_cast<std::size_t>(column / word_bits)];
  }
  // Darkens those pixels of that word whose bit is not set.
  void keep(int row, int column, std::uint64_t bits) {
    words_[static_cast<std::size_t>(row - first_row_) * stride_ +
           static_cast<std::size_t>(column / word_bits)] &= bits;
  }
  // Position of a word's lowest bit.
  int row(std::size_t word) const { return first_row_ + static_cast<int>(word / stride_); }
  int column(std::size_t word) const { return word_bits * static_cast<int>(word % stride_); }

 private:
  static constexpr std::size_t spare = 2;  // words, for what ends at the last

  template <bool light>
  void fill(ConvexArea const& area);

  int columns_ = 0;
  int first_row_ = 0;
  int end_row_ = 0;
  std::size_t stride_ = 0;  // words of a row
  std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(spare);
};

}  // namespace gpu_shading
