#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geometry/bvh.h"
#include "gpu_shading/polygon.h"
#include "gpu_shading/shading_rule.h"
#include "rays/ray_tree.h"

namespace gpu_shading {

// An end of a ray that is this near to a surface's plane lies on it, m.
inline constexpr double on_plane = 1e-9;

// The box with a margin for the rounding of a ray that meets its sides.
Box with_margin(Box box);

// Polygons as rays meet them: flat and whole or, unless they are flat, as triangles.
class RayShapes {
 public:
  // Nothing is added for a degenerate polygon.
  void add(SurfaceId surface, Polygon const& polygon);
  // All must have been added.
  void make_tree();

  // Calls met(surface, distance) for what a ray meets no farther than at `limit`, which `met` may
  // change.
  template <typename Met>
  void search(RayPath const& ray, double const& limit, Met const& met) const {
    tree_.search(ray, limit, [&](std::uint32_t place) {
      Shape const& shape = shapes_[place];
      if (auto const at = distance(shape, ray, limit)) met(shape.surface, *at);
    });
  }

 private:
  using Vertex = std::array<double, 3>;

  struct alignas(64) Shape {
    glm::dvec3 normal{0.0};
    glm::dvec3 centre{0.0};
    std::uint32_t first = 0;  // of vertices_
    std::uint32_t count = 0;
    SurfaceId surface = 0;
  };

  static double dot(glm::dvec3 const& a, glm::dvec3 const& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }

  void add(SurfaceId surface, Ring const& outline, std::span<Ring const> holes,
           glm::dvec3 const& normal);

  Box bounds(Shape const& shape) const;

  // Where the ray meets the shape, if it does.
  std::optional<double> distance(Shape const& shape, RayPath const& ray, double limit) const {
    double const approach = dot(shape.normal, ray.direction);
    double const away = dot(shape.normal, shape.centre - ray.origin);
    if (std::abs(away) <= on_plane) return std::nullopt;
    double const distance = away / approach;
    // Negated for a ray along the plane.
    if (!(distance > 0.0 && distance <= limit)) return std::nullopt;
    if (!((ray.length - distance) * std::abs(approach) > on_plane)) return std::nullopt;
    if (!is_within(shape, ray)) return std::nullopt;
    return distance;
  }

  // Whether the ray's line passes the inside, by the odd-even rule.
  bool is_within(Shape const& shape, RayPath const& ray) const;

  // In the tree's order.
  std::vector<Shape> shapes_;
  // All rings of a shape as one: from the outline's first vertex to each hole, around it, and back.
  // The ways there and back cancel.
  std::vector<Vertex> vertices_;
  RayTree tree_;
};

}  // namespace gpu_shading
