#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>

namespace gpu_shading {

// Counterclockwise, in a plane. Vertices beyond `count` have no value.
struct ConvexPolygon {
  static constexpr std::size_t max_vertices = 48;

  ConvexPolygon() {}  // NOLINT(modernize-use-equals-default): that would set all vertices to 0
  ConvexPolygon(ConvexPolygon const& other) { *this = other; }
  ConvexPolygon& operator=(ConvexPolygon const& other) {
    std::copy_n(other.vertices.begin(), other.count, vertices.begin());
    count = other.count;
    low = other.low;
    high = other.high;
    return *this;
  }
  ~ConvexPolygon() = default;

  std::array<glm::dvec2, max_vertices> vertices;
  std::size_t count = 0;
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};

  std::span<glm::dvec2 const> ring() const { return {vertices.data(), count}; }
  double area() const;

  // Takes a ring, of either direction. False if it is not convex, or has more than `max_ring`
  // vertices.
  static constexpr std::size_t max_ring = 8;
  bool take(std::span<glm::dvec2 const> ring);
  // For vertices in either direction, and of a ring that may not be convex.
  void turn_counterclockwise();
  bool is_convex() const;

  bool contains(ConvexPolygon const& other) const;
  // Whether it is its own bounds, but for rounding.
  bool is_rectangle() const;
  bool may_meet(ConvexPolygon const& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y;
  }
};

enum class Meeting {
  apart,
  across,
  within,    // all of a polygon is inside of the other
  too_many,  // vertices
};

// Sets `common` to the part of a polygon that is inside of another, unless they are apart:
// Sutherland & Hodgman (1974).
Meeting intersect(ConvexPolygon const& polygon, ConvexPolygon const& other, ConvexPolygon& common);
// The same for a polygon that is a rectangle, at less cost.
Meeting intersect_rectangle(ConvexPolygon const& rectangle, ConvexPolygon const& other,
                            ConvexPolygon& common);

}  // namespace gpu_shading
