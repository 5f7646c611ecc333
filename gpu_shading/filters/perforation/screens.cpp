#include "filters/perforation/screens.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "filters/perforation/perforation_filter.h"
#include "geometry/convex_area.h"
#include "geometry/ring.h"
#include "geometry/triangulation.h"
#include "gpu_shading/perforated_screen.h"

namespace gpu_shading {

namespace {

glm::dvec2 place_on(TileAxes const& axes, glm::dvec3 const& point) {
  return {glm::dot(point - axes.origin, axes.u), glm::dot(point - axes.origin, axes.v)};
}

bool is_convex_quadrilateral(Polygon const& polygon, Ring const& ring, glm::dvec3 const& normal) {
  if (!polygon.holes.empty() || ring.size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    glm::dvec3 const in = ring[(i + 1) % 4] - ring[i];
    glm::dvec3 const out = ring[(i + 2) % 4] - ring[(i + 1) % 4];
    if (glm::dot(glm::cross(in, out), normal) <= 0.0) return false;
  }
  return true;
}

std::vector<Screens::Quadrilateral> parts_of(Polygon const& polygon, Ring const& ring,
                                             glm::dvec3 const& normal, TileAxes const& axes) {
  std::vector<Screens::Quadrilateral> parts;
  auto const add = [&](std::array<glm::dvec3, 4> const& corners) {
    parts.push_back({corners,
                     {place_on(axes, corners[0]), place_on(axes, corners[1]),
                      place_on(axes, corners[2]), place_on(axes, corners[3])}});
  };
  if (is_convex_quadrilateral(polygon, ring, normal)) {
    add({ring[0], ring[1], ring[2], ring[3]});
    return parts;
  }
  Mesh const mesh = triangulate(polygon);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    glm::dvec3 const& a = mesh.vertices[mesh.indices[i]];
    glm::dvec3 const& b = mesh.vertices[mesh.indices[i + 1]];
    glm::dvec3 const& c = mesh.vertices[mesh.indices[i + 2]];
    add({a, b, c, c});
  }
  return parts;
}

}  // namespace

TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement) {
  Ring const ring = without_repeats(polygon.outline);
  glm::dvec3 const facing = glm::normalize(newell(ring));
  glm::dvec3 const edge = ring[2] - ring[1];
  glm::dvec3 const right = glm::normalize(edge - facing * glm::dot(facing, edge));
  glm::dvec3 const up = glm::cross(facing, right);
  double const c = std::cos(placement.rotation);
  double const s = std::sin(placement.rotation);
  return {ring[1] + placement.origin_u * right + placement.origin_v * up, c * right + s * up,
          c * up - s * right};
}

Screens::Screens(Scene const& scene) : numbers_(scene.size(), none) {
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    Surface const& surface = scene[id];
    auto const* const sheet = surface.filter.find<PerforatedSheet>();
    if (sheet == nullptr) continue;
    Ring const ring = without_repeats(surface.polygon.outline);
    glm::dvec3 const vector = newell(ring);
    if (ring.size() < 3 || is_degenerate(ring, vector)) continue;
    glm::dvec3 const normal = glm::normalize(vector);
    TileAxes const axes = tile_axes(surface.polygon, sheet->placement);
    BeamFilter::Faces const faces = faces_of(*sheet);
    numbers_[id] = static_cast<int>(entries_.size());
    entries_.push_back({sheet->screen, normal, axes.u, axes.v, faces.inside, faces.outside,
                        sheet->deployment, parts_of(surface.polygon, ring, normal, axes)});
  }
}

namespace {

using Outline = std::vector<glm::dvec2>;

double twice_area(Outline const& ring) {
  double twice = 0.0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    twice += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return twice;
}

// Both convex and counterclockwise.
Outline common(Outline ring, Outline const& by) {
  Outline kept;
  for (std::size_t i = 0; i < by.size() && !ring.empty(); ++i) {
    glm::dvec2 const along = by[(i + 1) % by.size()] - by[i];
    kept.clear();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      glm::dvec2 const& p = ring[k];
      glm::dvec2 const& q = ring[(k + 1) % ring.size()];
      double const at_p = cross(along, p - by[i]);
      double const at_q = cross(along, q - by[i]);
      if (at_p >= 0.0) kept.push_back(p);
      if ((at_p < 0.0) != (at_q < 0.0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    std::swap(ring, kept);
  }
  return ring;
}

struct PartOnTile {
  int screen;
  Outline on_tile;
  glm::dvec2 least;
  glm::dvec2 most;

  PartOnTile(int number, Outline ring) : screen(number), on_tile(std::move(ring)) {
    least = most = on_tile.front();
    for (glm::dvec2 const& corner : on_tile) {
      least = glm::min(least, corner);
      most = glm::max(most, corner);
    }
  }

  bool is_near(PartOnTile const& other) const {
    return glm::all(glm::lessThan(least, other.most)) && glm::all(glm::lessThan(other.least, most));
  }
};

std::vector<PartOnTile> parts_on_tile(Screens const& screens, std::span<int const> numbers,
                                      View const& view) {
  Outline const tile{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<PartOnTile> parts;
  for (int const number : numbers) {
    for (Screens::Quadrilateral const& part : screens[number].parts) {
      Outline ring;
      for (glm::dvec3 const& corner : part.corners) {
        glm::dvec3 const p = corner - view.origin;
        ring.emplace_back(at(view.x, p), at(view.y, p));
      }
      if (twice_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
      ring = common(std::move(ring), tile);
      if (ring.size() > 2) parts.emplace_back(number, std::move(ring));
    }
  }
  return parts;
}

}  // namespace

bool any_overlap(Screens const& screens, std::span<int const> numbers, View const& view) {
  // Of the tile, of area 4: neighbours that touch do not overlap.
  constexpr double least = 1e-6;
  std::vector<PartOnTile> const parts = parts_on_tile(screens, numbers, view);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      if (parts[i].screen == parts[k].screen || !parts[i].is_near(parts[k])) continue;
      if (twice_area(common(parts[i].on_tile, parts[k].on_tile)) > least) return true;
    }
  }
  return false;
}

}  // namespace gpu_shading
