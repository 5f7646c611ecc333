#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// A receiver, surface 0, behind casters, and directions of the sun that it faces.
struct InventedScene {
  Scene scene;
  std::vector<SunDirection> suns;
};

// A kind of casters: louvres, leaves, a city, ...
struct SceneFamily {
  char const* name;
  InventedScene (*invent)(std::uint32_t seed, int suns);
};

// Scenes of a family differ in everything that their kind leaves open: the number of casters (20 to
// some 5,000), their sizes and distances, the receiver's size (0.3 to 500 m), orientation and
// outline (a rectangle in every other scene, or an L, a frame, a star, a comb, a strip or a
// sliver), and the sun's altitude (0.1 to 80 degrees). Equal seeds give equal scenes.
std::span<SceneFamily const> scene_families();

// The sunlit fraction of surface 0, exact to about 1e-12, by a sweep of all edges; independent of
// samples. Casters must be flat, and may not be perforated. NaN if the sweep would take more than
// some seconds.
double swept_sunlit_fraction(Scene const& scene, SunDirection sun);

}  // namespace gpu_shading
