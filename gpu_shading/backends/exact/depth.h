#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "geometry/plane_frame.h"
#include "geometry/ring.h"

namespace gpu_shading {

// Of surfaces that are not so far apart, the first in a list receives the sun, in metres.
inline constexpr double same_place = 1e-6;

// The distance behind a receiver's plane of what a ray meets, by its place in the plane.
struct Depth {
  glm::dvec2 slope{0.0};
  double start = 0.0;

  double at(glm::dvec2 const& place) const { return start + glm::dot(slope, place); }
};

// Empty for a surface that rays pass along.
inline std::optional<Depth> depth_of(Ring const& ring, PlaneFrame const& frame,
                                     glm::dvec3 const& towards_sun) {
  constexpr double along = 1e-9;
  glm::dvec3 const vector = newell(ring);
  if (ring.size() < 3 || is_degenerate(ring, vector)) return std::nullopt;
  glm::dvec3 const normal = glm::normalize(vector);
  double const across = glm::dot(normal, towards_sun);
  if (std::abs(across) < along) return std::nullopt;
  // A ray from p, in the plane, is p - s (t / n.s) at a distance of t behind the plane.
  double const scale = glm::dot(frame.normal, towards_sun) / across;
  return Depth{scale * glm::dvec2(frame.width * glm::dot(normal, frame.u),
                                  frame.height * glm::dot(normal, frame.v)),
               scale * glm::dot(normal, frame.origin - ring[0])};
}

}  // namespace gpu_shading
