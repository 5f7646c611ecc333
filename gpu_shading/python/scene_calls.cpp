#include <utility>
#include <variant>

#include "geometry/triangulation.h"
#include "python/guard.h"

namespace gpu_shading::python {
namespace {

Polygon polygon_of(SurfaceRecord const& record) {
  Polygon polygon;
  auto const* vertex = record.vertices;
  for (std::size_t i = 0; i < record.rings; ++i) {
    Ring ring;
    ring.reserve(record.ring_sizes[i]);
    for (std::size_t k = 0; k < record.ring_sizes[i]; ++k, vertex += 3) {
      ring.emplace_back(vertex[0], vertex[1], vertex[2]);
    }
    if (i == 0) {
      polygon.outline = std::move(ring);
    } else {
      polygon.holes.push_back(std::move(ring));
    }
  }
  return polygon;
}

}  // namespace

GPU_SHADING_CALL int gpu_shading_scene_new(SceneObject** made) {
  return guarded([&] { *made = new SceneObject; });
}

// Keeps what it needs of the transmittance and the screen.
GPU_SHADING_CALL int gpu_shading_scene_add(SceneObject* scene, SurfaceRecord const* surface) {
  return guarded([&] {
    Surface added;
    added.name = surface->name;
    added.polygon = polygon_of(*surface);
    added.casting = enumerator(surface->casting, Casting::never, "casting");
    if (surface->filter != nullptr) {
      FilterFactor factor = surface->filter->factor;
      if (auto* const crown = std::get_if<Crown>(&factor)) crown->deployment = surface->deployment;
      added.filter.set(std::move(factor));
    }
    if (surface->screen != nullptr) {
      added.filter.set(PerforatedSheet{surface->screen->screen,
                                       {surface->origin_u, surface->origin_v, surface->rotation},
                                       surface->deployment});
    }
    added.filter.schedule = surface->schedule;
    scene->scene.add(std::move(added));
  });
}

// Roles: wall, zone, shades and target of each surface; zone_shades: zones x zones.
GPU_SHADING_CALL int gpu_shading_scene_set_rule(SceneObject* scene, std::uint32_t const* roles,
                                                std::size_t surfaces,
                                                std::uint8_t const* zone_shades,
                                                std::size_t zones) {
  return guarded([&] {
    ShadingRule rule;
    for (std::size_t i = 0; i < surfaces; ++i) {
      auto const* role = roles + 4 * i;
      rule.roles.push_back(
          {role[0], role[1],
           enumerator(static_cast<int>(role[2]), ShadingRule::Shades::one_surface, "shades"),
           role[3]});
    }
    rule.zones = zones;
    rule.zone_shades.assign(zone_shades, zone_shades + zones * zones);
    scene->scene.set_rule(std::move(rule));
  });
}

// Net area (m2) times unit normal of each surface: surfaces x 3.
GPU_SHADING_CALL int gpu_shading_scene_areas(SceneObject const* scene, double* results) {
  return guarded([&] {
    for (SurfaceId id = 0; id < scene->scene.size(); ++id) {
      auto const& polygon = scene->scene[id].polygon;
      auto const vector = area(polygon) * normal(polygon);
      for (int axis = 0; axis < 3; ++axis) *results++ = vector[axis];
    }
  });
}

// The corners of a surface's triangles: triangles x 3 x 3; nullptr: only their number.
GPU_SHADING_CALL int gpu_shading_scene_triangles(SceneObject const* scene, std::size_t surface,
                                                 double* corners, std::size_t* triangles) {
  return guarded([&] {
    auto const mesh = triangulate(scene->scene[static_cast<SurfaceId>(surface)].polygon);
    *triangles = mesh.indices.size() / 3;
    if (corners == nullptr) return;
    for (auto const index : mesh.indices) {
      for (int axis = 0; axis < 3; ++axis) *corners++ = mesh.vertices[index][axis];
    }
  });
}

GPU_SHADING_CALL void gpu_shading_scene_release(SceneObject* scene) { release(scene); }

}  // namespace gpu_shading::python
