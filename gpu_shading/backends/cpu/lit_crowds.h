#pragma once

#include <cstddef>
#include <deque>
#include <glm/vec3.hpp>
#include <mutex>
#include <utility>

#include "gpu_shading/scene.h"
#include "view/pixel_mask.h"
#include "view/tile.h"

namespace gpu_shading {

// What crowds of casters leave lit of windows. EnergyPlus asks about the surfaces behind a window
// soon after the window itself, at the same sun. Any number of threads may ask.
class LitCrowds {
 public:
  // Rows of samples of a tile.
  struct Key {
    SurfaceId receiver = 0;
    glm::dvec3 towards_sun{0.0};
    double slope = 0.0;
    TileGrid grid;
    int first_row = 0;

    bool operator==(Key const&) const = default;
  };

  // Moves what is kept into `lit`. False if there is nothing.
  bool take(Key const& key, PixelMask& lit);
  // The oldest are dropped beyond 32 MiB.
  void keep(Key const& key, PixelMask const& lit);

 private:
  std::mutex mutex_;
  std::deque<std::pair<Key, PixelMask>> kept_;
  std::size_t words_ = 0;
};

}  // namespace gpu_shading
