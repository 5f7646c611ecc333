#include "geometry/convex_polygon.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "geometry/convex_area.h"

namespace gpu_shading {
namespace {

void set_bounds(ConvexPolygon& polygon) {
  polygon.low = polygon.high = polygon.vertices[0];
  for (glm::dvec2 const& vertex : polygon.ring()) {
    polygon.low = glm::min(polygon.low, vertex);
    polygon.high = glm::max(polygon.high, vertex);
  }
}

// Of a cut along an axis.
struct Limit {
  int axis;
  double at;
  double side;  // 1: what is above it stays; -1: what is below
};

void cut(ConvexPolygon const& from, Limit const& limit, ConvexPolygon& to) {
  to.count = 0;
  glm::dvec2 last = from.vertices[from.count - 1];
  double last_inside = limit.side * (last[limit.axis] - limit.at);
  for (glm::dvec2 const& vertex : from.ring()) {
    double const inside = limit.side * (vertex[limit.axis] - limit.at);
    if ((inside > 0.0) != (last_inside > 0.0)) {
      glm::dvec2& crossing = to.vertices[to.count++];
      crossing = last + last_inside / (last_inside - inside) * (vertex - last);
      crossing[limit.axis] = limit.at;
    }
    if (inside > 0.0) to.vertices[to.count++] = vertex;
    last = vertex;
    last_inside = inside;
  }
}

}  // namespace

double ConvexPolygon::area() const {
  double twice = 0.0;
  for (std::size_t i = 2; i < count; ++i) {
    twice += cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
  }
  return 0.5 * twice;
}

bool ConvexPolygon::take(std::span<glm::dvec2 const> ring) {
  if (ring.size() < 3 || ring.size() > max_ring) return false;
  std::copy(ring.begin(), ring.end(), vertices.begin());
  count = ring.size();
  set_bounds(*this);
  turn_counterclockwise();
  return is_convex();
}

void ConvexPolygon::turn_counterclockwise() {
  if (area() < 0.0) std::reverse(vertices.begin(), vertices.begin() + static_cast<long>(count));
}

bool ConvexPolygon::is_convex() const {
  // By which a corner may turn the other way, of the squares of its sides: rounding.
  constexpr double straight = 1e-13;
  glm::dvec2 before = vertices[0] - vertices[count - 1];
  int turns = 0;  // of an edge to the other side: twice in a ring that goes around once
  bool rising = before.y > 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec2 const edge = vertices[i + 1 < count ? i + 1 : 0] - vertices[i];
    double const turn = cross(before, edge);
    if (turn < 0.0 && turn < -straight * (glm::dot(before, before) + glm::dot(edge, edge))) {
      return false;
    }
    bool const rises = edge.y > 0.0;
    if (rises != rising) ++turns;
    rising = rises;
    before = edge;
  }
  return turns <= 2;
}

bool ConvexPolygon::contains(ConvexPolygon const& other) const {
  constexpr double rounding = 1e-12;
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec2 const edge = vertices[i + 1 < count ? i + 1 : 0] - vertices[i];
    for (glm::dvec2 const& vertex : other.ring()) {
      if (cross(edge, vertex - vertices[i]) < -rounding * glm::length(edge)) return false;
    }
  }
  return true;
}

bool ConvexPolygon::is_rectangle() const {
  constexpr double rounding = 1e-13;
  glm::dvec2 const most = rounding * (high - low);
  return count == 4 && std::ranges::all_of(ring(), [&](glm::dvec2 const& vertex) {
           glm::dvec2 const off = glm::min(vertex - low, high - vertex);
           return off.x <= most.x && off.y <= most.y;
         });
}

Meeting intersect(ConvexPolygon const& polygon, ConvexPolygon const& other, ConvexPolygon& common) {
  if (polygon.count + other.count > ConvexPolygon::max_vertices) return Meeting::too_many;
  if (!polygon.may_meet(other)) return Meeting::apart;
  ConvexPolygon cut;
  std::array<double, ConvexPolygon::max_vertices> beyond;  // NOLINT: set before use
  ConvexPolygon const* from = &polygon;
  // Each cut goes where the one before it is not; the last to `common`, or is copied there.
  for (std::size_t k = 0; k < other.count; ++k) {
    glm::dvec2 const start = other.vertices[k];
    glm::dvec2 const edge = other.vertices[k + 1 < other.count ? k + 1 : 0] - start;
    // Between a vertex and its repetition, an edge has the direction of rounding.
    constexpr double rounding = 1e-14;
    double const least = rounding * (1.0 + std::abs(start.x) + std::abs(start.y));
    if (glm::dot(edge, edge) < least * least) continue;
    bool any_inside = false;
    bool any_outside = false;
    for (std::size_t i = 0; i < from->count; ++i) {
      beyond[i] = cross(edge, from->vertices[i] - start);
      any_inside = any_inside || beyond[i] > 0.0;
      any_outside = any_outside || beyond[i] < 0.0;
    }
    if (!any_inside) return Meeting::apart;
    if (!any_outside) continue;
    ConvexPolygon& to = from == &common ? cut : common;
    to.count = 0;
    std::size_t last = from->count - 1;
    for (std::size_t i = 0; i < from->count; last = i++) {
      if ((beyond[i] > 0.0) != (beyond[last] > 0.0)) {
        double const share = beyond[last] / (beyond[last] - beyond[i]);
        to.vertices[to.count++] =
            from->vertices[last] + share * (from->vertices[i] - from->vertices[last]);
      }
      if (beyond[i] > 0.0) to.vertices[to.count++] = from->vertices[i];
    }
    from = &to;
  }
  bool const whole = from == &polygon;
  if (from != &common) common = *from;
  set_bounds(common);
  return whole ? Meeting::within : Meeting::across;
}

Meeting intersect_rectangle(ConvexPolygon const& rectangle, ConvexPolygon const& other,
                            ConvexPolygon& common) {
  if (!rectangle.may_meet(other)) return Meeting::apart;
  ConvexPolygon other_half;
  ConvexPolygon const* from = &other;
  auto const cut_at = [&](Limit const& limit) {
    ConvexPolygon& to = from == &common ? other_half : common;
    cut(*from, limit, to);
    from = &to;
    return to.count >= 3;
  };
  for (int axis = 0; axis < 2; ++axis) {
    double const low = rectangle.low[axis];
    double const high = rectangle.high[axis];
    if (other.low[axis] < low && !cut_at({axis, low, 1.0})) return Meeting::apart;
    if (other.high[axis] > high && !cut_at({axis, high, -1.0})) return Meeting::apart;
  }
  if (from != &common) common = *from;
  set_bounds(common);
  constexpr double rounding = 1e-14;
  glm::dvec2 const size = rectangle.high - rectangle.low;
  bool const whole = common.low == rectangle.low && common.high == rectangle.high &&
                     common.area() >= (1.0 - rounding) * size.x * size.y;
  return whole ? Meeting::within : Meeting::across;
}

}  // namespace gpu_shading
