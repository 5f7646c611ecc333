#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "gpu_shading/polygon.h"
#include "gpu_shading/shading_rule.h"
#include "rays/ray_path.h"
#include "scene/bvh.h"

namespace gpu_shading {

// An end of a ray that is this near to a surface's plane lies on it, m.
inline constexpr double on_plane = 1e-9;

// Polygons that rays meet, with or without a surface's body around them.
class RayShapes {
 public:
  // The polygon as rays meet it: flat and whole or, unless it is flat, as triangles. Nothing if it
  // is degenerate.
  void add(SurfaceId surface, Polygon const& polygon);

  std::size_t size() const { return shapes_.size(); }
  SurfaceId surface(std::uint32_t shape) const { return shapes_[shape].surface; }
  Box bounds(std::uint32_t shape) const;
  // In the order of a tree.
  void sort(std::span<std::uint32_t const> order);

  // The distance at which a ray meets a shape, if it does and no farther than at `limit`.
  std::optional<double> distance(std::uint32_t shape, RayPath const& ray, double limit) const {
    Shape const& met = shapes_[shape];
    double const approach = dot(met.normal, ray.direction);
    double const away = dot(met.normal, met.centre - ray.origin);
    if (std::abs(away) <= on_plane) return std::nullopt;
    double const distance = away / approach;
    // Negated for a ray along the plane.
    if (!(distance > 0.0 && distance <= limit)) return std::nullopt;
    if (!((ray.length - distance) * std::abs(approach) > on_plane)) return std::nullopt;
    if (!is_within(met, ray)) return std::nullopt;
    return distance;
  }

 private:
  using Vertex = std::array<double, 3>;

  struct Shape {
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

  // Whether the ray's line passes the inside, by the odd-even rule.
  bool is_within(Shape const& shape, RayPath const& ray) const;

  std::vector<Shape> shapes_;
  // All rings of a shape as one: from the outline's first vertex to each hole, around it, and back.
  // The ways there and back cancel.
  std::vector<Vertex> vertices_;
};

}  // namespace gpu_shading
