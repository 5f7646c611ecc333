#include "view/pixel_mask.h"

#include <bit>

#include "platform/instructions.h"

namespace gpu_shading {
namespace {

constexpr int word_bits = PixelMask::word_bits;

template <bool light>
void set(std::uint64_t& word, std::uint64_t bits) {
  word = light ? word | bits : word & ~bits;
}

// Shorter than a word: within one word or two.
template <bool light>
void set_short(std::uint64_t* row, std::int32_t first, std::int32_t length) {
  std::uint64_t const bits = (std::uint64_t{1} << static_cast<unsigned>(length)) - 1;
  auto const shift = static_cast<unsigned>(first % word_bits);
  std::uint64_t* const word = row + first / word_bits;
  set<light>(word[0], bits << shift);
  set<light>(word[1], bits >> 1U >> (word_bits - 1 - shift));
}

template <bool light>
void set_long(std::uint64_t* row, std::int32_t first, std::int32_t length) {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  if (length == 0) return;
  std::int32_t const last = first + length - 1;
  std::uint64_t const from = all << static_cast<unsigned>(first % word_bits);
  std::uint64_t const to = all >> static_cast<unsigned>(word_bits - 1 - last % word_bits);
  std::uint64_t* word = row + first / word_bits;
  std::uint64_t* const last_word = row + last / word_bits;
  if (word == last_word) return set<light>(*word, from & to);
  set<light>(*word, from);
  while (++word != last_word) *word = light ? all : 0;
  set<light>(*word, to);
}

[[gnu::always_inline]] inline std::uint64_t count(std::uint64_t const* a, std::uint64_t const* b,
                                                  std::size_t words) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < words; ++i) {
    sum += static_cast<std::uint64_t>(std::popcount(a[i] & b[i]));
  }
  return sum;
}

// Areas thinner than a pixel miss the centres of most rows.
constexpr std::int32_t thin = 1;

// One bit per row, of spans that are no longer than a pixel.
std::uint64_t rows_with_any(RowSpans const& spans, int rows) {
  static_assert(RowSpans::most <= word_bits);
  std::uint64_t any = 0;
  for (int row = 0; row < rows; row += RowSpans::at_once) {
    std::int32_t const* const length = &spans.length[static_cast<std::size_t>(row)];
    std::int32_t some = 0;
    for (int i = 0; i < RowSpans::at_once; ++i) some |= length[i] << i;
    any |= static_cast<std::uint64_t>(some) << row;
  }
  return any & (~std::uint64_t{0} >> (word_bits - rows));
}

}  // namespace

std::uint64_t count_common(std::span<std::uint64_t const> a, std::span<std::uint64_t const> b) {
  return run<count>(a.data(), b.data(), std::min(a.size(), b.size()));
}

void PixelMask::start(int columns, int first_row, int end_row) {
  columns_ = columns;
  first_row_ = first_row;
  end_row_ = end_row;
  stride_ = static_cast<std::size_t>((columns + word_bits - 1) / word_bits);
  words_.assign(static_cast<std::size_t>(end_row - first_row) * stride_ + spare, 0);
}

void PixelMask::count_rows(std::span<double> counts) const {
  for (std::size_t row = 0; row < words().size() / stride_; ++row) {
    auto const of_row = words().subspan(row * stride_, stride_);
    counts[row] += static_cast<double>(count_common(of_row, of_row));
  }
}

bool PixelMask::any_lit(int first_row, int end_row, int first_column, int end_column) const {
  constexpr std::uint64_t all = ~std::uint64_t{0};
  int const last_column = end_column - 1;
  std::uint64_t const from = all << static_cast<unsigned>(first_column % word_bits);
  std::uint64_t const to = all >> static_cast<unsigned>(word_bits - 1 - last_column % word_bits);
  int const first_word = first_column / word_bits;
  int const last_word = last_column / word_bits;
  std::uint64_t const* row = &words_[static_cast<std::size_t>(first_row - first_row_) * stride_];
  for (int i = first_row; i < end_row; ++i, row += stride_) {
    for (int word = first_word; word <= last_word; ++word) {
      std::uint64_t lit = row[word];
      if (word == first_word) lit &= from;
      if (word == last_word) lit &= to;
      if (lit != 0) return true;
    }
  }
  return false;
}

template <bool light>
void PixelMask::fill(ConvexArea const& area) {
  auto const fill_rows = [&](int row, int rows, RowSpans const& spans) {
    auto const count = static_cast<std::size_t>(rows);
    std::uint64_t* words = &words_[static_cast<std::size_t>(row - first_row_) * stride_];
    if (spans.longest <= thin) {
      for (std::uint64_t rest = rows_with_any(spans, rows); rest != 0; rest &= rest - 1) {
        auto const i = static_cast<std::size_t>(std::countr_zero(rest));
        set_short<light>(words + i * stride_, spans.first[i], spans.length[i]);
      }
    } else if (spans.longest < word_bits) {
      for (std::size_t i = 0; i < count; ++i, words += stride_) {
        set_short<light>(words, spans.first[i], spans.length[i]);
      }
    } else {
      for (std::size_t i = 0; i < count; ++i, words += stride_) {
        set_long<light>(words, spans.first[i], spans.length[i]);
      }
    }
  };
  each_rows_of_spans(area, columns_, first_row_, end_row_, fill_rows);
}

void PixelMask::light(ConvexArea const& area) { fill<true>(area); }
void PixelMask::darken(ConvexArea const& area) { fill<false>(area); }

}  // namespace gpu_shading
