#include "geometry/triangulation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "geometry/odd_even.h"
#include "geometry/ring.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// Whether it turns left at every corner and goes round once.
bool is_convex(Ring const& ring, glm::dvec3 const& up) {
  double turned = 0.0;
  std::size_t const n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    glm::dvec3 const in = glm::normalize(ring[(i + 1) % n] - ring[i]);
    glm::dvec3 const out = glm::normalize(ring[(i + 2) % n] - ring[(i + 1) % n]);
    double const sine = glm::dot(up, glm::cross(in, out));
    constexpr double straight = -1e-9;
    if (sine < straight) return false;
    turned += std::atan2(sine, glm::dot(in, out));
  }
  return turned < 3.0 * std::numbers::pi;
}

Mesh fan(Ring const& ring) {
  Mesh mesh{ring, {}};
  mesh.indices.reserve(3 * (ring.size() - 2));
  for (std::uint32_t i = 1; i + 1 < ring.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, i, i + 1});
  }
  return mesh;
}

// A polygon's rings on an integer grid in its plane, and back.
class Grid {
 public:
  Grid(std::vector<Ring> rings, glm::dvec3 const& up) : rings_(std::move(rings)) {
    // Along the longest edge, as most openings are: that makes few triangles.
    glm::dvec3 longest(0.0);
    Ring const& outline = rings_.front();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      glm::dvec3 const edge = outline[(i + 1) % outline.size()] - outline[i];
      if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
    }
    glm::dvec3 const u = glm::normalize(longest - up * glm::dot(up, longest));
    glm::dvec3 const v = glm::cross(up, u);
    auto const position = [&](glm::dvec3 const& vertex) {
      glm::dvec3 const p = vertex - outline[0];
      return glm::dvec2(glm::dot(p, u), glm::dot(p, v));
    };
    double reach = 0.0;
    for (Ring const& ring : rings_) {
      for (glm::dvec3 const& vertex : ring) {
        glm::dvec2 const p = glm::abs(position(vertex));
        reach = std::max({reach, p.x, p.y});
      }
    }
    double const scale = grid_limit / reach;
    for (Ring const& ring : rings_) {
      std::vector<glm::ivec2>& points = points_.emplace_back();
      for (glm::dvec3 const& vertex : ring) {
        glm::ivec2 const point(glm::round(scale * position(vertex)));
        points.push_back(point);
        vertices_.try_emplace({point.x, point.y}, vertex);
      }
    }
  }

  std::vector<std::vector<glm::ivec2>> const& rings() const { return points_; }

  // The polygon's own vertex, or else the position on the edge that the point was rounded from.
  glm::dvec3 vertex_at(glm::ivec2 const& point) const {
    auto const own = vertices_.find({point.x, point.y});
    if (own != vertices_.end()) return own->second;
    double nearest = std::numeric_limits<double>::infinity();
    glm::dvec3 vertex(0.0);
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      for (std::size_t k = 0; k < rings_[i].size(); ++k) {
        std::size_t const next = (k + 1) % rings_[i].size();
        glm::dvec2 const from(points_[i][k]);
        glm::dvec2 const along = glm::dvec2(points_[i][next]) - from;
        double const square = glm::dot(along, along);
        if (square == 0.0) continue;
        double const share =
            std::clamp(glm::dot(glm::dvec2(point) - from, along) / square, 0.0, 1.0);
        double const distance = glm::distance(from + share * along, glm::dvec2(point));
        if (distance >= nearest) continue;
        nearest = distance;
        vertex = glm::mix(rings_[i][k], rings_[i][next], share);
      }
    }
    return vertex;
  }

 private:
  std::vector<Ring> rings_;
  std::vector<std::vector<glm::ivec2>> points_;
  std::map<std::pair<int, int>, glm::dvec3> vertices_;
};

Mesh cover(Ring const& outline, std::vector<Ring> const& holes, glm::dvec3 const& up) {
  std::vector<Ring> rings{outline};
  for (Ring const& hole : holes) {
    Ring ring = without_repeats(hole);
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  Grid const grid(std::move(rings), up);
  GridMesh const covered = triangulate_odd_even(grid.rings());
  Mesh mesh;
  mesh.vertices.reserve(covered.points.size());
  for (glm::ivec2 const& point : covered.points) mesh.vertices.push_back(grid.vertex_at(point));
  mesh.indices = covered.indices;
  return mesh;
}

// Both triangles as one piece, if they share an edge, lie in one plane, and turn left at every
// corner.
std::optional<glm::uvec4> joined(Mesh const& mesh, glm::uvec3 const& a, glm::uvec3 const& b) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (a[i] != b[(j + 1) % 3] || a[(i + 1) % 3] != b[j]) continue;
      glm::uvec4 const corners(a[(i + 1) % 3], a[(i + 2) % 3], a[i], b[(j + 2) % 3]);
      Ring ring;
      for (int k = 0; k < 4; ++k) ring.push_back(mesh.vertices[corners[k]]);
      glm::dvec3 const vector = newell(ring);
      double const size = glm::length(vector);
      if (size == 0.0) return std::nullopt;
      glm::dvec3 const up = vector / size;
      constexpr double flat = 1e-9;
      for (glm::dvec3 const& corner : ring) {
        if (std::abs(glm::dot(corner - ring[0], up)) > flat) return std::nullopt;
      }
      if (!is_convex(ring, up)) return std::nullopt;
      return corners;
    }
  }
  return std::nullopt;
}

}  // namespace

Mesh triangulate(Polygon const& polygon) {
  Ring const outline = without_repeats(polygon.outline);
  if (outline.size() < 3) return {};
  glm::dvec3 const vector = newell(outline);
  if (is_degenerate(outline, vector)) return {};
  glm::dvec3 const up = glm::normalize(vector);
  if (polygon.holes.empty() && is_convex(outline, up)) return fan(outline);
  return cover(outline, polygon.holes, up);
}

std::vector<Mesh> triangulate_all(Scene const& scene) {
  std::vector<Mesh> meshes;
  meshes.reserve(scene.size());
  std::size_t vertices = 0;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    meshes.push_back(triangulate(scene[id].polygon));
    vertices += meshes.back().vertices.size();
    if (vertices > std::numeric_limits<std::uint32_t>::max()) {
      throw Error("the scene has more vertices than can be numbered with 32 bits");
    }
  }
  return meshes;
}

std::vector<glm::uvec4> convex_pieces(Mesh const& mesh) {
  std::vector<glm::uvec4> pieces;
  auto const triangle = [&](std::size_t i) {
    return glm::uvec3(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    glm::uvec3 const here = triangle(i);
    if (i + 3 < mesh.indices.size()) {
      if (auto const both = joined(mesh, here, triangle(i + 3))) {
        pieces.push_back(*both);
        i += 3;
        continue;
      }
    }
    pieces.emplace_back(here, here.z);
  }
  return pieces;
}

}  // namespace gpu_shading
