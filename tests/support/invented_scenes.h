#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"
#include "gpu_shading/sunlit.h"

namespace gpu_shading {

// Sunlit fractions of what is asked for, one after another, with all schedules at each of these.
inline constexpr std::array schedule_factors{0.0, 0.5, 1.0};

// Of answers to one question about a receiver of this projected area.
std::vector<double> fractions_of(std::span<Sunlit const> answers, double projected_area);

struct ReferenceFractions {
  std::vector<double> fractions;  // none where the reference cannot tell
  double error = 0.0;             // that it may have
};

// A receiver, surface 0, behind casters, and directions of the sun that it faces.
struct InventedScene {
  Scene scene;
  std::vector<SunDirection> suns;
  // Asked for in place of the receiver, which is a window in front of them.
  std::vector<SurfaceId> interiors;
  std::function<ReferenceFractions(Scene const&, SunDirection)> reference;
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
//
// References are independent of samples: sweeps of all edges, exact to about 1e-12; behind
// perforated sheets, clipped outlines of holes (RegularSheets); and behind crowns, rays from points
// of four lattices, whose spread tells their error.
std::span<SceneFamily const> scene_families();

}  // namespace gpu_shading
