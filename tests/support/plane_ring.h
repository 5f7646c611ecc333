#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

// Areas in a plane, of rings whose last vertex is not repeated.
namespace gpu_shading {

inline double crossed(glm::dvec2 const& a, glm::dvec2 const& b) { return a.x * b.y - a.y * b.x; }

// Positive if the ring turns anticlockwise.
inline double signed_area(std::vector<glm::dvec2> const& ring) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    twice += crossed(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return twice / 2.0;
}

}  // namespace gpu_shading
