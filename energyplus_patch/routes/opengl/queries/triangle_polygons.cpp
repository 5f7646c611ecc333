#include "routes/opengl/queries/triangle_polygons.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace gpu_shading::energyplus {
namespace {

using Vertex = std::array<float, 3>;  // x, y, z

// Edges by their start.
using Edges = std::multimap<Vertex, Vertex>;

Vertex to_vertex(glm::vec3 const& p) { return {p.x, p.y, p.z}; }
glm::dvec3 to_point(Vertex const& v) { return {v[0], v[1], v[2]}; }

Edges::iterator find(Edges& edges, Vertex const& from, Vertex const& to) {
  auto const [begin, end] = edges.equal_range(from);
  auto const found = std::find_if(begin, end, [&](auto const& edge) { return edge.second == to; });
  return found == end ? edges.end() : found;
}

// Edges inside a polygon are run through in both directions, once by each triangle beside them.
Edges boundary_of(std::span<glm::vec3 const> triangles) {
  constexpr std::size_t corners = 3;
  Edges edges;
  for (std::size_t i = 0; i + corners <= triangles.size(); i += corners) {
    for (std::size_t k = 0; k < corners; ++k) {
      auto const from = to_vertex(triangles[i + k]);
      auto const to = to_vertex(triangles[i + (k + 1) % corners]);
      if (from == to) continue;
      auto const opposite = find(edges, to, from);
      if (opposite != edges.end()) {
        edges.erase(opposite);
      } else {
        edges.emplace(from, to);
      }
    }
  }
  return edges;
}

// Takes a closed ring out of the edges. Every vertex has as many edges that begin as that end.
Ring take_ring(Edges& edges) {
  Ring ring;
  auto edge = edges.begin();
  auto const start = edge->first;
  while (edge != edges.end()) {
    ring.push_back(to_point(edge->first));
    auto const next = edge->second;
    edges.erase(edge);
    if (next == start) break;
    edge = edges.find(next);
  }
  return ring;
}

glm::dvec3 area_vector(Ring const& ring) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += glm::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]) / 2.0;
  }
  return sum;
}

// Whether a point is within a ring as seen along the axis in which its normal is longest.
bool contains(Ring const& ring, glm::dvec3 const& normal, glm::dvec3 const& point) {
  auto const n = glm::abs(normal);
  int const axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  int const u = (axis + 1) % 3;
  int const v = (axis + 2) % 3;
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& a = ring[i];
    auto const& b = ring[(i + 1) % ring.size()];
    if ((a[v] > point[v]) == (b[v] > point[v])) continue;
    if (point[u] < a[u] + (b[u] - a[u]) * (point[v] - a[v]) / (b[v] - a[v])) inside = !inside;
  }
  return inside;
}

}  // namespace

std::vector<Polygon> polygons_of(std::span<glm::vec3 const> triangles) {
  auto edges = boundary_of(triangles);
  std::vector<Ring> rings;
  glm::dvec3 whole(0.0);
  while (!edges.empty()) {
    rings.push_back(take_ring(edges));
    whole += area_vector(rings.back());
  }
  std::vector<Polygon> polygons;
  std::vector<Ring> holes;
  for (auto& ring : rings) {
    if (glm::dot(area_vector(ring), whole) > 0.0) {
      polygons.push_back({std::move(ring), {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (auto& hole : holes) {
    if (polygons.empty()) break;
    // A hole may touch the outline at vertices, but not with all of its edges.
    auto const middle = (hole[0] + hole[1 % hole.size()]) / 2.0;
    auto around = std::ranges::find_if(polygons, [&](Polygon const& polygon) {
      return polygons.size() == 1 || contains(polygon.outline, whole, middle);
    });
    if (around == polygons.end()) around = polygons.begin();
    around->holes.push_back(std::move(hole));
  }
  return polygons;
}

}  // namespace gpu_shading::energyplus
