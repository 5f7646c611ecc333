#include "scene/relative_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "geometry/convex_polygon.h"
#include "geometry/ring.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

bool is_flat_and_convex(std::span<glm::dvec3 const> ring, glm::dvec3 const& normal) {
  constexpr double flat = 1e-11;  // deviation
  if (ring.size() < 3 || ring.size() > ConvexPolygon::max_ring) return false;
  double const most = flat * glm::length(normal);
  // Seen along the axis that its normal is nearest to.
  glm::dvec3 const size = glm::abs(normal);
  int const axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  std::array<glm::dvec2, ConvexPolygon::max_ring> places;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (std::abs(glm::dot(ring[i] - ring[0], normal)) > most) return false;
    places[i] = {ring[i][axis == 0 ? 1 : 0], ring[i][axis == 2 ? 1 : 2]};
  }
  ConvexPolygon polygon;
  return polygon.take(std::span(places).first(ring.size()));
}

}  // namespace

void RelativePolygon::set(SurfaceId id, Polygon const& polygon, PlaneFrame const& frame,
                          Side side) {
  id_ = id;
  points_.clear();
  ends_.clear();
  add(polygon.outline, frame, side);
  for (Ring const& hole : polygon.holes) add(hole, frame, side);
  normal_ = newell(ring(0));
  is_convex_ = is_flat_and_convex(ring(0), normal_);
  bool const is_caster = side == Side::in_front;
  if (is_caster && std::ranges::none_of(ring(0), [](auto const& p) { return p.z > coplanar; })) {
    ends_.assign(1, 0);
  }
}

void RelativePolygon::add(Ring const& ring, PlaneFrame const& frame, Side side) {
  auto const relative = [&](glm::dvec3 const& vertex) {
    glm::dvec3 const p = vertex - frame.origin;
    return glm::dvec3(glm::dot(frame.u, p) / frame.width, glm::dot(frame.v, p) / frame.height,
                      side == Side::within ? 0.0 : glm::dot(frame.normal, p));
  };
  auto const beyond = [&](glm::dvec3 const& place) {
    switch (side) {
      case Side::in_front:
        return place.z;
      case Side::behind:
        return -place.z - clearance;
      case Side::within:
        break;
    }
    return 1.0;
  };
  if (!ring.empty()) {
    glm::dvec3 from = relative(ring.back());
    for (glm::dvec3 const& vertex : ring) {
      glm::dvec3 const to = relative(vertex);
      double const from_beyond = beyond(from);
      double const to_beyond = beyond(to);
      if ((to_beyond > 0.0) != (from_beyond > 0.0)) {
        points_.push_back(from + (to - from) * (from_beyond / (from_beyond - to_beyond)));
      }
      if (to_beyond > 0.0) points_.push_back(to);
      from = to;
    }
  }
  ends_.push_back(static_cast<std::uint32_t>(points_.size()));
}

}  // namespace gpu_shading
