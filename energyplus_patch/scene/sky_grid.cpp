#include "scene/sky_grid.h"

#include <cstddef>

namespace gpu_shading::energyplus {

std::vector<SunDirection> const& sky_patches() {
  static auto const patches = [] {
    std::vector<SunDirection> all;
    for (int altitude = 0; altitude < sky_rows; ++altitude) {
      for (int azimuth = 0; azimuth < sky_columns; ++azimuth) {
        all.push_back({sky_step * azimuth, sky_step * (altitude + 0.5)});
      }
    }
    return all;
  }();
  return patches;
}

}  // namespace gpu_shading::energyplus
