#pragma once

#include <vector>

#include "support/shapes.h"

namespace gpu_shading {

// A room 4 m wide, 5 m deep, 3 m high, with a window in the south wall; the surfaces that the sun
// may reach through it.
struct Room {
  Scene scene;
  SurfaceId window = scene.add({"window", south_facing(1, 0, 0.8, 2, 1.6)});
  std::vector<SurfaceId> surfaces{
      scene.add({"floor", level(0, 0, 0, 4, 5)}),
      scene.add({"ceiling", level(0, 0, 3, 4, 5)}),
      scene.add({"north wall", south_facing(0, 5, 0, 4, 3)}),
      scene.add({"west wall", parallelogram({0, 0, 0}, {0, 5, 0}, {0, 0, 3})}),
      scene.add({"east wall", parallelogram({4, 0, 0}, {0, 5, 0}, {0, 0, 3})}),
  };
};

// What passes no scheduled shade.
inline std::vector<double> interior_areas(Renderer& renderer, SunDirection sun, SurfaceId window,
                                          std::span<SurfaceId const> interiors) {
  std::vector<double> areas;
  for (Sunlit const& answer : renderer.interior_sunlit_areas(sun, window, interiors)) {
    areas.push_back(answer.projected_area);
  }
  return areas;
}

}  // namespace gpu_shading
