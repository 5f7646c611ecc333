#include "gpu_shading/footprint.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/algorithms/within.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cstddef>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

namespace bg = boost::geometry;
using Plan = bg::model::polygon<bg::model::d2::point_xy<double>, false>;  // counter-clockwise

// A footprint in plan, relative to its first corner, so that neither the antimeridian nor the
// distance from the model matters.
Plan::ring_type ring_seen_from(LocalAxes const& here, GeographicRing const& ring) {
  Plan::ring_type plan;
  plan.reserve(ring.size() + 1);
  for (auto const& corner : ring) {
    auto const local = here.to_local({corner.latitude, corner.longitude, 0.0});
    plan.emplace_back(local.x, local.y);
  }
  if (!plan.empty()) plan.push_back(plan.front());
  return plan;
}

// Corners within 1 mm of one another are merged.
void drop_repeats(Plan::ring_type& ring) {
  constexpr double same = 1e-3;
  auto const near = [](auto const& a, auto const& b) { return bg::distance(a, b) <= same; };
  ring.erase(std::unique(ring.begin(), ring.end(), near), ring.end());
  while (ring.size() > 1 && near(ring.front(), ring.back())) ring.pop_back();
  if (!ring.empty()) ring.push_back(ring.front());
}

std::string reason(bg::validity_failure_type failure) {
  switch (failure) {
    case bg::failure_self_intersections:
    case bg::failure_intersecting_interiors:
      return "its outline crosses itself, another ring or a courtyard";
    case bg::failure_spikes:
      return "its outline turns back on itself";
    case bg::failure_interior_rings_outside:
    case bg::failure_nested_interior_rings:
    case bg::failure_disconnected_interior:
      return "a courtyard is not inside its outline";
    default:
      return "it is not a valid area";
  }
}

Plan plan_of(Footprint const& footprint, LocalAxes const& here) {
  Plan plan;
  plan.outer() = ring_seen_from(here, footprint.outline);
  for (auto const& hole : footprint.holes) {
    plan.inners().push_back(ring_seen_from(here, hole));
  }
  return plan;
}

LocalAxes axes_about(Footprint const& footprint) {
  if (footprint.outline.empty()) throw Error("0 corners, expected three");
  return LocalAxes({footprint.outline.front().latitude, footprint.outline.front().longitude, 0.0});
}

Plan checked_plan(Footprint const& footprint, LocalAxes const& here) {
  auto plan = plan_of(footprint, here);
  drop_repeats(plan.outer());
  for (auto& inner : plan.inners()) drop_repeats(inner);
  auto const corners = [](Plan::ring_type const& ring) {
    return ring.empty() ? ring.size() : ring.size() - 1;
  };
  if (corners(plan.outer()) < 3) {
    throw Error(fmt::format("{} corners, expected three", corners(plan.outer())));
  }
  std::erase_if(plan.inners(), [&](auto const& inner) { return corners(inner) < 3; });
  bg::correct(plan);
  auto failure = bg::no_failure;
  if (!bg::is_valid(plan, failure)) throw Error(reason(failure));
  constexpr double min_area = 1e-3;  // m2
  if (bg::area(plan) < min_area) throw Error("it has no area");
  return plan;
}

Ring raised(Plan::ring_type const& ring, double elevation, LocalAxes const& here,
            LocalAxes const& axes) {
  Ring raised;
  raised.reserve(ring.size());
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    auto position = here.to_geographic({ring[i].x(), ring[i].y(), 0.0});
    position.elevation = elevation;
    raised.push_back(axes.to_local(position));
  }
  return raised;
}

// Faces to the right of a ring's direction, as seen from above.
void add_walls(Ring const& low, Ring const& high, std::vector<Polygon>& faces) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    std::size_t const next = (i + 1) % low.size();
    faces.push_back({{high[i], low[i], low[next], high[next]}, {}});
  }
}

}  // namespace

std::vector<Polygon> upright_prism(Footprint const& footprint, LocalAxes const& axes) {
  // Negated so that NaN is rejected.
  if (!(footprint.top > footprint.base)) {
    throw Error(fmt::format("its top at {} m is not above its base at {} m", footprint.top,
                            footprint.base));
  }
  auto const here = axes_about(footprint);
  auto const plan = checked_plan(footprint, here);
  Polygon roof;
  std::vector<Polygon> faces(1);
  auto const add = [&](Plan::ring_type const& ring) {
    auto high = raised(ring, footprint.top, here, axes);
    add_walls(raised(ring, footprint.base, here, axes), high, faces);
    return high;
  };
  roof.outline = add(plan.outer());
  for (auto const& inner : plan.inners()) roof.holes.push_back(add(inner));
  faces[0] = std::move(roof);
  return faces;
}

bool covers(Polygon const& roof, glm::dvec3 const& point) {
  auto const ring_of = [](Ring const& corners) {
    Plan::ring_type ring;
    for (auto const& corner : corners) ring.emplace_back(corner.x, corner.y);
    return ring;
  };
  Plan plan;
  plan.outer() = ring_of(roof.outline);
  for (auto const& hole : roof.holes) plan.inners().push_back(ring_of(hole));
  bg::correct(plan);
  return bg::within(bg::model::d2::point_xy<double>(point.x, point.y), plan);
}

}  // namespace gpu_shading
