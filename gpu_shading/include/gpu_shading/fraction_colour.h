#pragma once

#include <glm/vec3.hpp>

namespace gpu_shading {

// The colour of a sunlit fraction, 0 .. 1, as red, green and blue, 0 .. 255: from dark blue for 0
// to yellow for 1. The colour map is cividis (Nunez, Anderton & Renslow 2018), which is legible
// with any kind of colour vision and in grey.
glm::dvec3 fraction_colour(double fraction);

}  // namespace gpu_shading
