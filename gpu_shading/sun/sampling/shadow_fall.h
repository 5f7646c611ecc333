#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gpu_shading {

// The position on a receiver's plane of the shadow of a point one metre in front of it: the
// distance along the plane's horizontal line and the distance across it, each as its inverse
// hyperbolic sine, in metres.
//
// Behind horizontal slats, the sunlit fraction depends on the second value alone, behind vertical
// ones on the first, and linearly while shadows are short. At grazing incidence, shadows grow
// without bound, which the inverse hyperbolic sine reduces to a few metres.
//
// `normal`, pointing outside, and `towards_sun` are unit vectors; the cosine of the angle between
// them is limited to least_cosine or more.
glm::dvec2 shadow_fall(glm::dvec3 const& normal, glm::dvec3 const& towards_sun);

}  // namespace gpu_shading
