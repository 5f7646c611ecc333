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

double LuminanceTile::sum(std::size_t word, std::uint64_t pixels) const {
  constexpr auto width = static_cast<std::size_t>(PixelMask::word_bits);
  float const* const luminance = this->pixels().data() + word * width;
  double sum = 0.0;
  if (pixels == ~std::uint64_t{0}) {
    std::array<double, 8> lanes{};
    for (std::size_t i = 0; i < width; i += lanes.size()) {
      for (std::size_t k = 0; k < lanes.size(); ++k) {
        lanes[k] += static_cast<double>(luminance[i + k]);
      }
    }
    for (double const lane : lanes) sum += lane;
    return sum;
  }
  for (std::uint64_t rest = pixels; rest != 0; rest &= rest - 1) {
    sum += static_cast<double>(luminance[std::countr_zero(rest)]);
  }
  return sum;
}

}  // namespace gpu_shading
