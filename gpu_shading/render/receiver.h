#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "render/view.h"
#include "scene/plane_frame.h"

namespace gpu_shading {

// What is known of a receiver whatever the sun's direction.
struct Receiver {
  std::optional<PlaneFrame> frame;  // nothing when it has no area
  double area = 0.0;                // exact, m2
  TileMap map;
  std::vector<glm::vec2> tile;          // its triangles, in clip coordinates
  std::vector<SurfaceId> in_front;      // casters of any direction
  std::optional<std::uint64_t> pixels;  // on its tile, once counted
};

}  // namespace gpu_shading
