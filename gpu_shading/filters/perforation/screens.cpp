#include "filters/perforation/screens.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "filters/perforation/perforation_filter.h"
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

}  // namespace gpu_shading
