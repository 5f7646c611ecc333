#pragma once

#include <span>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// The ring without vertices that repeat the previous one (within a nanometre), including the last
// one compared with the first.
Ring without_repeats(Ring const& ring);

// Newell's vector: along the ring's normal, with twice its area as length. Computed relative to the
// ring's first vertex, so that large site coordinates cost no precision.
glm::dvec3 newell(std::span<glm::dvec3 const> ring);

// Whether a ring with this Newell vector encloses too little area to have a plane: less than 1e-12
// of its length squared.
bool is_degenerate(Ring const& ring, glm::dvec3 const& newell_vector);

}  // namespace gpu_shading
