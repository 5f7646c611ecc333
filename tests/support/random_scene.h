#pragma once

#include <cstdint>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

struct RandomScene {
  Scene scene;  // surface 0 is the receiver
  SunDirection sun;
};

// A receiver 1 to 6 m in size and one to six casters in front of it, some of them through its
// plane; a third of the polygons are convex, a third non-convex, and a third have a hole. The sun
// is at least 6 degrees above the receiver's plane. Equal seeds give equal scenes.
RandomScene random_scene(std::uint32_t seed);

// Opaque triangles of all sizes and orientations in front of a receiver, which is surface 0.
Scene triangle_soup(int count, std::uint32_t seed);

}  // namespace gpu_shading
