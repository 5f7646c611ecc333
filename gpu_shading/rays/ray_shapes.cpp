#include "rays/ray_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "geometry/ring.h"
#include "geometry/triangulation.h"

namespace gpu_shading {
namespace {

glm::dvec3 mean(Ring const& ring) {
  glm::dvec3 sum(0.0);
  for (glm::dvec3 const& vertex : ring) sum += vertex - ring[0];
  return ring[0] + sum / static_cast<double>(ring.size());
}

bool is_flat(Ring const& ring, glm::dvec3 const& normal) {
  constexpr double flat = 1e-6;
  glm::dvec3 const centre = mean(ring);
  return std::all_of(ring.begin(), ring.end(), [&](glm::dvec3 const& vertex) {
    return std::abs(glm::dot(vertex - centre, normal)) <= flat;
  });
}

}  // namespace

Box with_margin(Box box) {
  glm::dvec3 const margin = 1e-8 + 1e-12 * glm::max(glm::abs(box.low), glm::abs(box.high));
  box.low -= margin;
  box.high += margin;
  return box;
}

void RayShapes::add(SurfaceId surface, Polygon const& polygon) {
  Ring const outline = without_repeats(polygon.outline);
  if (outline.size() < 3) return;
  glm::dvec3 const vector = newell(outline);
  if (is_degenerate(outline, vector)) return;
  glm::dvec3 const normal = glm::normalize(vector);
  if (is_flat(outline, normal)) return add(surface, outline, polygon.holes, normal);
  Mesh const mesh = triangulate(polygon);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Ring const triangle{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                        mesh.vertices[mesh.indices[i + 2]]};
    glm::dvec3 const across = newell(triangle);
    if (glm::length(across) > 0.0) add(surface, triangle, {}, glm::normalize(across));
  }
}

void RayShapes::add(SurfaceId surface, Ring const& outline, std::span<Ring const> holes,
                    glm::dvec3 const& normal) {
  Shape shape{normal, mean(outline), static_cast<std::uint32_t>(vertices_.size()), 0, surface};
  auto const add_vertices = [&](Ring const& ring) {
    for (glm::dvec3 const& vertex : ring) vertices_.push_back({vertex.x, vertex.y, vertex.z});
  };
  add_vertices(outline);
  for (Ring const& hole : holes) {
    if (hole.empty()) continue;
    add_vertices({outline.front()});
    add_vertices(hole);
    add_vertices({hole.front()});
  }
  shape.count = static_cast<std::uint32_t>(vertices_.size()) - shape.first;
  shapes_.push_back(shape);
}

Box RayShapes::bounds(Shape const& shape) const {
  Box box;
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    Vertex const& vertex = vertices_[shape.first + i];
    box.include(glm::dvec3(vertex[0], vertex[1], vertex[2]));
  }
  return with_margin(box);
}

void RayShapes::make_tree() {
  std::vector<Box> boxes;
  boxes.reserve(shapes_.size());
  for (Shape const& shape : shapes_) boxes.push_back(bounds(shape));
  tree_ = RayTree(boxes);
  std::vector<Shape> shapes;
  std::vector<Vertex> vertices;
  shapes.reserve(shapes_.size());
  vertices.reserve(vertices_.size());
  for (std::uint32_t const number : tree_.order()) {
    Shape& shape = shapes.emplace_back(shapes_[number]);
    auto const from = vertices_.begin() + shape.first;
    shape.first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), from, from + shape.count);
  }
  shapes_ = std::move(shapes);
  vertices_ = std::move(vertices);
}

bool RayShapes::is_within(Shape const& shape, RayPath const& ray) const {
  struct Seen {
    double x;
    double y;
  };
  Vertex const* const vertices = &vertices_[shape.first];
  // In the ray's projection, in which the ray is the origin.
  auto const seen = [&ray](Vertex const& vertex) -> Seen {
    double const ahead = vertex[ray.axes[2]] - ray.start[2];
    return {vertex[ray.axes[0]] - ray.start[0] - ray.shear[0] * ahead,
            vertex[ray.axes[1]] - ray.start[1] - ray.shear[1] * ahead};
  };
  bool inside = false;
  Seen from = seen(vertices[shape.count - 1]);
  for (std::uint32_t i = 0; i < shape.count; ++i) {
    Seen const to = seen(vertices[i]);
    if ((from.y > 0.0) != (to.y > 0.0)) {
      // From the lower end to the upper one, so that an edge of two shapes is on the same side of
      // the ray for both, whatever rounding does.
      Seen const& low = from.y > 0.0 ? to : from;
      Seen const& high = from.y > 0.0 ? from : to;
      if (low.x * high.y - low.y * high.x > 0.0) inside = !inside;
    }
    from = to;
  }
  return inside;
}

}  // namespace gpu_shading
