#include "scene/flat_polygon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {

glm::dvec3 longest_edge(Ring const& ring) {
  glm::dvec3 longest{0.0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const edge = ring[(i + 1) % ring.size()] - ring[i];
    if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
  }
  return longest;
}

bool is_inside(std::vector<FlatRing> const& rings, glm::dvec2 const& point) {
  bool odd = false;
  for (auto const& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      auto const& a = ring[i];
      auto const& b = ring[(i + 1) % ring.size()];
      if ((a.y > point.y) == (b.y > point.y)) continue;
      if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
  }
  return odd;
}

glm::dvec2 spread_point(std::size_t i) {
  // The powers of the inverse of the plastic number.
  constexpr glm::dvec2 step{0.7548776662466927, 0.5698402909980532};
  return glm::fract(glm::dvec2(0.5) + static_cast<double>(i + 1) * step);
}

}  // namespace gpu_shading::energyplus
