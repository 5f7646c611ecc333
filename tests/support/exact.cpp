#include "support/exact.h"

#include <algorithm>
#include <clipper.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "gpu_shading/transmittance.h"

namespace gpu_shading::exact {
namespace {

using ClipperLib::Clipper;
using ClipperLib::Path;
using ClipperLib::Paths;

constexpr double units_per_metre = 1e8;

glm::dvec3 newell(Ring const& ring) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += glm::cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
  }
  return sum;
}

struct Plane {
  glm::dvec3 point;
  glm::dvec3 normal;

  double height(glm::dvec3 const& p) const { return glm::dot(normal, p - point); }
};

Plane plane_of(Polygon const& polygon) {
  return {polygon.outline[0], glm::normalize(newell(polygon.outline))};
}

// Sutherland & Hodgman: the part in front of the plane. Pieces of a non-convex ring stay joined by
// edges in the plane, which enclose no area.
Ring in_front(Ring const& ring, Plane const& plane) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    glm::dvec3 const& a = ring[i];
    glm::dvec3 const& b = ring[(i + 1) % ring.size()];
    double const height_a = plane.height(a);
    double const height_b = plane.height(b);
    if (height_a > 0.0) kept.push_back(a);
    if ((height_a > 0.0) != (height_b > 0.0)) {
      kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
  }
  return kept;
}

// The plane normal to the sun's rays, relative to a point near the model.
struct Screen {
  glm::dvec3 origin;
  glm::dvec3 right;
  glm::dvec3 up;

  Screen(glm::dvec3 const& towards_sun, glm::dvec3 const& about) : origin(about) {
    glm::dvec3 const any =
        std::abs(towards_sun.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    right = glm::normalize(glm::cross(any, towards_sun));
    up = glm::cross(towards_sun, right);
  }

  Path project(Ring const& ring) const {
    Path path;
    for (glm::dvec3 const& p : ring) {
      path.emplace_back(
          static_cast<ClipperLib::cInt>(
              std::llround(glm::dot(right, p - origin) * units_per_metre)),
          static_cast<ClipperLib::cInt>(std::llround(glm::dot(up, p - origin) * units_per_metre)));
    }
    return path;
  }

  Paths project(Polygon const& polygon) const {
    Paths paths{project(polygon.outline)};
    for (Ring const& hole : polygon.holes) paths.push_back(project(hole));
    return paths;
  }
};

Polygon cut(Polygon const& polygon, Plane const& plane) {
  Polygon kept{in_front(polygon.outline, plane), {}};
  for (Ring const& hole : polygon.holes) kept.holes.push_back(in_front(hole, plane));
  return kept;
}

Paths combine(Paths const& a, Paths const& b, ClipperLib::ClipType how) {
  Clipper clipper;
  clipper.AddPaths(a, ClipperLib::ptSubject, true);
  clipper.AddPaths(b, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(how, result, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  return result;
}

double area_of(Paths const& paths) {
  double sum = 0.0;
  for (Path const& path : paths) sum += ClipperLib::Area(path);
  return std::abs(sum) / (units_per_metre * units_per_metre);
}

bool is_empty(Polygon const& polygon) { return polygon.outline.size() < 3; }

// The sunlit parts and their luminance.
struct Part {
  Paths paths;
  double luminance = 1.0;
};

double let_through(Surface const& surface, SunDirection sun, std::span<double const> factors) {
  if (!surface.filter.transmits()) return 0.0;
  double through = 1.0;
  if (auto const* const shade = surface.filter.find<AngularTransmittance>()) {
    double const cosine = glm::dot(glm::normalize(newell(surface.polygon.outline)), to_vector(sun));
    through *= (*shade->model)(std::acos(std::min(1.0, std::abs(cosine))));
  }
  if (surface.filter.schedule >= 0)
    through *= factors[static_cast<std::size_t>(surface.filter.schedule)];
  return through;
}

std::vector<Part> lit_parts(Scene const& scene, SunDirection sun, SurfaceId receiver,
                            Screen const& screen, std::span<double const> factors) {
  Plane const plane = plane_of(scene[receiver].polygon);
  if (glm::dot(plane.normal, to_vector(sun)) <= 0.0) return {};
  std::vector<Part> parts{
      {combine(screen.project(scene[receiver].polygon), {}, ClipperLib::ctUnion), 1.0}};
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (!scene.may_shade(receiver, id) || is_empty(scene[id].polygon)) continue;
    Polygon const front = cut(scene[id].polygon, plane);
    if (is_empty(front)) continue;
    Paths const shadow = screen.project(front);
    double const through = let_through(scene[id], sun, factors);
    std::vector<Part> left;
    for (Part const& part : parts) {
      Paths const shaded = combine(part.paths, shadow, ClipperLib::ctIntersection);
      if (shaded.empty()) {
        left.push_back(part);
        continue;
      }
      left.push_back({combine(part.paths, shadow, ClipperLib::ctDifference), part.luminance});
      if (through > 0.0) left.push_back({shaded, part.luminance * through});
    }
    parts = std::move(left);
  }
  return parts;
}

}  // namespace

double projected_sunlit_area(Scene const& scene, SunDirection sun, SurfaceId receiver,
                             std::span<double const> factors) {
  Screen const screen(to_vector(sun), scene[receiver].polygon.outline[0]);
  double sum = 0.0;
  for (Part const& part : lit_parts(scene, sun, receiver, screen, factors)) {
    sum += part.luminance * area_of(part.paths);
  }
  return sum;
}

double projected_area(Scene const& scene, SunDirection sun, SurfaceId receiver) {
  Polygon const& polygon = scene[receiver].polygon;
  double twice = glm::length(newell(polygon.outline));
  for (Ring const& hole : polygon.holes) twice -= glm::length(newell(hole));
  return 0.5 * twice * std::max(0.0, glm::dot(plane_of(polygon).normal, to_vector(sun)));
}

std::vector<double> interior_areas(Scene const& scene, SunDirection sun, SurfaceId window,
                                   std::vector<SurfaceId> const& interiors,
                                   std::span<double const> factors) {
  Screen const screen(to_vector(sun), scene[window].polygon.outline[0]);
  Plane behind = plane_of(scene[window].polygon);
  behind.normal = -behind.normal;
  std::vector<double> areas(interiors.size(), 0.0);
  for (Part const& part : lit_parts(scene, sun, window, screen, factors)) {
    Paths left = part.paths;
    for (std::size_t i = 0; i < interiors.size(); ++i) {
      Polygon const seen = cut(scene[interiors[i]].polygon, behind);
      if (is_empty(seen)) continue;
      Paths const projected = screen.project(seen);
      areas[i] += part.luminance * area_of(combine(left, projected, ClipperLib::ctIntersection));
      left = combine(left, projected, ClipperLib::ctDifference);
    }
  }
  return areas;
}

double shadow_area(Scene const& scene, SunDirection sun, SurfaceId receiver, SurfaceId caster) {
  Polygon const& polygon = scene[receiver].polygon;
  Polygon const front = cut(scene[caster].polygon, plane_of(polygon));
  if (is_empty(front)) return 0.0;
  Screen const screen(to_vector(sun), polygon.outline[0]);
  return area_of(
      combine(screen.project(polygon), screen.project(front), ClipperLib::ctIntersection));
}

}  // namespace gpu_shading::exact
