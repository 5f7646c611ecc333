#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gpu_shading {

// Where on a receiver's plane the shadow falls of a point one metre before it: so far along the
// plane's level line, and so far across that; the inverse hyperbolic sine of either, metres.
//
// Behind level slats the sunlit fraction depends on the second alone, behind upright ones on the
// first, and linearly while shadows are short. When the sun grazes the plane they grow beyond all
// bounds, which the inverse hyperbolic sine makes a few metres of.
//
// `normal`, to the outside, and `towards_sun` are unit vectors; below least_cosine the angle
// between them is taken for that of least_cosine.
glm::dvec2 shadow_fall(glm::dvec3 const& normal, glm::dvec3 const& towards_sun);

}  // namespace gpu_shading
