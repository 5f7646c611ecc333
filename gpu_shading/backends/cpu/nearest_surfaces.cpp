#include "backends/cpu/nearest_surfaces.h"

#include <cstddef>

namespace gpu_shading {

void NearestSurfaces::add(ConvexArea const& area, DepthPlane const& depth, std::uint32_t number) {
  depths_.each_span(area, [&](int row, int first, int length) {
    std::span<double> const depths = depths_.row(row);
    std::span<std::uint32_t> const numbers = numbers_.row(row);
    for (int column = first; column < first + length; ++column) {
      auto const pixel = static_cast<std::size_t>(column);
      double const here = depth.at(column, row);
      if (here + tie_ >= depths[pixel]) continue;
      depths[pixel] = here;
      numbers[pixel] = number;
    }
  });
}

}  // namespace gpu_shading
