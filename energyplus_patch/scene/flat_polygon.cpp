#include "scene/flat_polygon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace gpu_shading::energyplus {
namespace {

// Axes of a polygon's plane, the first along its longest edge: a rectangle fills its bounds.
struct Plane {
  glm::dvec3 origin;
  glm::dvec3 along;
  glm::dvec3 across;

  glm::dvec2 project(glm::dvec3 const& point) const {
    return {glm::dot(point - origin, along), glm::dot(point - origin, across)};
  }
  glm::dvec3 place(glm::dvec2 const& point) const {
    return origin + point.x * along + point.y * across;
  }
};

}  // namespace

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

std::vector<glm::dvec3> polygon_samples(Polygon const& polygon, std::size_t count) {
  auto const up = normal(polygon);
  if (glm::dot(up, up) <= 0.0) return {};
  auto along = longest_edge(polygon.outline);
  along = glm::normalize(along - glm::dot(along, up) * up);
  Plane const plane{polygon.outline.front(), along, glm::cross(up, along)};

  std::vector<FlatRing> rings;
  auto const add = [&](Ring const& ring) {
    auto& flat = rings.emplace_back();
    for (auto const& point : ring) flat.push_back(plane.project(point));
  };
  add(polygon.outline);
  for (auto const& hole : polygon.holes) add(hole);
  glm::dvec2 low = rings.front().front();
  glm::dvec2 high = low;
  for (auto const& point : rings.front()) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }

  constexpr std::size_t tries = 64;  // for each point that is wanted
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < tries * count && points.size() < count; ++i) {
    auto const point = low + spread_point(i) * (high - low);
    if (is_inside(rings, point)) points.push_back(plane.place(point));
  }
  return points;
}

}  // namespace gpu_shading::energyplus
