#include "gpu_shading/polygon.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/ring.h"

namespace gpu_shading {

Ring without_repeats(Ring const& ring) {
  constexpr double same = 1e-9;
  Ring distinct;
  distinct.reserve(ring.size());
  for (glm::dvec3 const& vertex : ring) {
    if (distinct.empty() || glm::distance(vertex, distinct.back()) > same) {
      distinct.push_back(vertex);
    }
  }
  while (distinct.size() > 1 && glm::distance(distinct.front(), distinct.back()) <= same) {
    distinct.pop_back();
  }
  return distinct;
}

glm::dvec3 newell(std::span<glm::dvec3 const> ring) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += glm::cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return sum;
}

bool is_degenerate(Ring const& ring, glm::dvec3 const& newell_vector) {
  double around = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    around += glm::distance(ring[i], ring[(i + 1) % ring.size()]);
  }
  constexpr double thinnest = 1e-12;
  // Negated so that a NaN counts as degenerate.
  return !(glm::length(newell_vector) > thinnest * around * around);
}

double area(Polygon const& polygon) {
  glm::dvec3 const outline = newell(polygon.outline);
  if (is_degenerate(polygon.outline, outline)) return 0.0;
  double twice = glm::length(outline);
  for (Ring const& hole : polygon.holes) twice -= glm::length(newell(hole));
  return std::max(0.0, 0.5 * twice);
}

glm::dvec3 normal(Polygon const& polygon) {
  glm::dvec3 const outline = newell(polygon.outline);
  if (is_degenerate(polygon.outline, outline)) return glm::dvec3(0.0);
  return glm::normalize(outline);
}

}  // namespace gpu_shading
