#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/random_scene.h"
#include "support/shapes.h"

// Casters of each kind that a back end treats in its own way.
namespace gpu_shading {

enum class CasterKind { opaque, transparent, screen, scheduled, scheduled_screen };

inline constexpr CasterKind caster_kinds[] = {CasterKind::opaque, CasterKind::transparent,
                                              CasterKind::screen, CasterKind::scheduled,
                                              CasterKind::scheduled_screen};

// Makes a surface a caster of a kind.
inline void finish(Surface& surface, CasterKind kind, int schedule) {
  static auto const glass =
      std::make_shared<Transmittance const>(Transmittance::polynomial_in_cosine({0.1, 0.5}));
  static auto const mesh = [] {
    HolePattern const holes(
        {.hole = Hole::Round, .arrangement = Arrangement::Staggered60, .size = 0.1, .pitch = 0.14});
    return std::make_shared<PerforatedScreen const>(holes, Sheet{.thickness = 0.01});
  }();
  bool const screened = kind == CasterKind::screen || kind == CasterKind::scheduled_screen;
  if (kind == CasterKind::transparent) surface.transmittance = glass;
  if (screened) surface.screen = mesh;
  if (kind == CasterKind::scheduled || kind == CasterKind::scheduled_screen) {
    surface.schedule = schedule;
  }
}

// A random scene on a site with others.
struct Lot {
  SurfaceId receiver = 0;
  std::vector<SurfaceId> casters;
  SunDirection sun;
};

// Adds random scenes side by side, each 50 m east of the one before. Two of three casters are of
// the kind, and the others are opaque.
inline std::vector<Lot> add_lots(Scene& scene, std::uint32_t count, CasterKind kind) {
  std::vector<Lot> lots;
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    RandomScene const random = random_scene(seed);
    Lot& lot = lots.emplace_back();
    lot.sun = random.sun;
    for (SurfaceId id = 0; id < random.scene.size(); ++id) {
      Surface surface = random.scene[id];
      for (glm::dvec3& vertex : surface.polygon.outline) vertex.x += 50.0 * seed;
      for (Ring& hole : surface.polygon.holes) {
        for (glm::dvec3& vertex : hole) vertex.x += 50.0 * seed;
      }
      if (id % 3 != 0) finish(surface, kind, static_cast<int>(id % 2));
      SurfaceId const added = scene.add(std::move(surface));
      if (id == 0) {
        lot.receiver = added;
      } else {
        lot.casters.push_back(added);
      }
    }
  }
  return lots;
}

}  // namespace gpu_shading
