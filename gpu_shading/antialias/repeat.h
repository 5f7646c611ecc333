#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// A surface that repeats another one, as louvres, fins and slats do.
struct Repeat {
  glm::dvec3 step{0.0};  // from the other one, m
  glm::dvec3 edge{0.0};  // the longest of its edges, m
};

// Empty if no surface shortly before it in the scene has the same shape and orientation.
std::optional<Repeat> repeat_of(Scene const& scene, SurfaceId id);

// Those of some casters, which stand for all of them.
struct SampledRepeats {
  std::vector<Repeat> found;
  double share = 0.0;  // of the casters, for each
};

// None where casters are few.
SampledRepeats repeats_among(Scene const& scene, std::span<SurfaceId const> casters);

}  // namespace gpu_shading
