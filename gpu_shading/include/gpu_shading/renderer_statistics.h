#pragma once

#include <cstddef>

namespace gpu_shading {

// What a renderer did since it was constructed. Times are wall-clock seconds.
struct RendererStatistics {
  std::size_t directions = 0;       // passed to projected_sunlit_areas
  std::size_t receivers_drawn = 0;  // pairs of receiver and direction with a caster in view
  std::size_t receivers_clear = 0;  // pairs answered exactly: sunlit, with nothing in view
  std::size_t casters_drawn = 0;    // sum over all drawn pairs
  std::size_t luminance_views = 0;  // drawn pairs with a transmitting shade in view
  double seconds = 0.0;             // wall-clock time in the renderer, of which:
  double cull_seconds = 0.0;        // finding casters in view
  double submit_seconds = 0.0;      // collecting, uploading and issuing draws
  double count_seconds = 0.0;       // rasterising and summing views on the CPU
  double wait_seconds = 0.0;        // waiting for the device
  double read_seconds = 0.0;        // reading the device's pixels or sums

  RendererStatistics& operator+=(RendererStatistics const& other);
};

}  // namespace gpu_shading
