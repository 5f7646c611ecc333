#include "render/luminance_tile.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gpu_shading {

void LuminanceTile::start(int side) {
  constexpr int word = PixelMask::word_bits;
  side_ = side;
  stride_ = static_cast<std::size_t>((side + word - 1) / word) * std::size_t{word};
  pixels_.assign(static_cast<std::size_t>(side) * stride_, 1.0F);
}

void LuminanceTile::multiply(ConvexArea const& area, float by) {
  RowSpans spans;
  for (int row = area.first_row; row < area.end_row; row += RowSpans::rows) {
    find_spans(area, row, side_, spans);
    if (spans.longest == 0) continue;
    int const rows = std::min(RowSpans::rows, area.end_row - row);
    for (int i = 0; i < rows; ++i) {
      auto const at = static_cast<std::size_t>(i);
      float* const first = pixels_.data() + static_cast<std::size_t>(row + i) * stride_ +
                           static_cast<std::size_t>(spans.first[at]);
      std::for_each(first, first + spans.length[at], [by](float& pixel) { pixel *= by; });
    }
  }
}

double LuminanceTile::sum(PixelMask const& lit) const {
  constexpr auto width = static_cast<std::size_t>(PixelMask::word_bits);
  double sum = 0.0;
  auto const words = lit.words();
  for (std::size_t word = 0; word < words.size(); ++word) {
    float const* const pixels = pixels_.data() + word * width;
    if (words[word] == ~std::uint64_t{0}) {
      std::array<double, 8> lanes{};
      for (std::size_t i = 0; i < width; i += lanes.size()) {
        for (std::size_t k = 0; k < lanes.size(); ++k) {
          lanes[k] += static_cast<double>(pixels[i + k]);
        }
      }
      for (double const lane : lanes) sum += lane;
      continue;
    }
    for (std::uint64_t rest = words[word]; rest != 0; rest &= rest - 1) {
      sum += static_cast<double>(pixels[std::countr_zero(rest)]);
    }
  }
  return sum;
}

}  // namespace gpu_shading
