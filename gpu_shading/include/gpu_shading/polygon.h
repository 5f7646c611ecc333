#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace gpu_shading {

// Vertices in order; the first is not repeated at the end.
using Ring = std::vector<glm::dvec3>;

// A planar polygon in metres, in world axes: x east, y north, z up. The outline runs
// counterclockwise as seen from outside (the side that the sun may light); holes may run either
// way. A polygon with fewer than three distinct vertices or without area neither casts nor
// receives. Non-convex polygons are allowed. A polygon that is not quite planar is projected to its
// Newell plane as a receiver, and used unchanged as a caster.
struct Polygon {
  Ring outline;
  std::vector<Ring> holes;
};

// Area of the outline minus its holes (m2), and the unit normal of the outline, both by Newell's
// method (Sutherland, Sproull & Schumacker 1974). The zero vector for a degenerate polygon.
double area(Polygon const& polygon);
glm::dvec3 normal(Polygon const& polygon);

}  // namespace gpu_shading
