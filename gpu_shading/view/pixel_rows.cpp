#include "view/pixel_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace gpu_shading {

void LuminanceTile::multiply(ConvexArea const& area, float by) {
  each_span(area, [&](int number, int first, int length) {
    float* const pixel = row(number).data() + first;
    std::for_each(pixel, pixel + length, [by](float& luminance) { luminance *= by; });
  });
}

void LuminanceTile::sum_rows(PixelMask const& lit, std::span<double> sums) const {
  constexpr auto width = static_cast<std::size_t>(PixelMask::word_bits);
  auto const words = lit.words();
  std::span<float const> const values = pixels();
  std::size_t const words_a_row = stride() / width;
  for (std::size_t word = 0; word < words.size(); ++word) {
    double& sum = sums[word / words_a_row];
    float const* const luminance = values.data() + word * width;
    if (words[word] == ~std::uint64_t{0}) {
      std::array<double, 8> lanes{};
      for (std::size_t i = 0; i < width; i += lanes.size()) {
        for (std::size_t k = 0; k < lanes.size(); ++k) {
          lanes[k] += static_cast<double>(luminance[i + k]);
        }
      }
      for (double const lane : lanes) sum += lane;
      continue;
    }
    for (std::uint64_t rest = words[word]; rest != 0; rest &= rest - 1) {
      sum += static_cast<double>(luminance[std::countr_zero(rest)]);
    }
  }
}

}  // namespace gpu_shading
