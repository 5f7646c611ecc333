#pragma once

#include <cstdint>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

struct RandomScene {
  Scene scene;  // surface 0 is the receiver
  SunDirection sun;
};

// A receiver of 1 to 6 m across and one to six casters in front of it, some of them through its
// plane; a third of the polygons convex, a third non-convex, a third with a hole. The sun stands at
// least 6 degrees above the receiver's plane. The same seed gives the same scene.
RandomScene random_scene(std::uint32_t seed);

}  // namespace gpu_shading
