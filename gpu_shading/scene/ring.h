#pragma once

#include "gpu_shading/scene.h"

namespace gpu_shading {

// The ring without vertices that repeat the one before (within a nanometre), the last against the
// first too.
Ring without_repeats(Ring const& ring);

// Newell's vector: along the ring's normal, twice its area long. Taken relative to the ring's first
// vertex, so that site coordinates cost no digits.
glm::dvec3 newell(Ring const& ring);

// Whether a ring of this Newell vector encloses too little to have a plane: less than 1e-12 of its
// length squared.
bool is_degenerate(Ring const& ring, glm::dvec3 const& newell_vector);

}  // namespace gpu_shading
