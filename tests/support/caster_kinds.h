#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <ostream>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/transmittance.h"
#include "support/crown_meshes.h"
#include "support/random_scene.h"
#include "support/shapes.h"

// Casters of each kind that a back end treats in its own way.
namespace gpu_shading {

struct CasterKind {
  char const* name;
  BeamFilter filter;
};

inline void PrintTo(CasterKind const& kind, std::ostream* out) { *out << kind.name; }

inline std::vector<CasterKind> const& caster_kinds() {
  static std::vector<CasterKind> const kinds = [] {
    FilterFactor const glass = AngularTransmittance{
        std::make_shared<Transmittance const>(Transmittance::polynomial_in_cosine({0.1, 0.5}))};
    FilterFactor const mesh = PerforatedSheet{std::make_shared<PerforatedScreen const>(
        HolePattern({.size = 0.1, .pitch = 0.14}), Sheet{.thickness = 0.01})};
    FilterFactor const crown = Crown{.height = 0.8, .leaf_density = 2.0};
    FilterFactor const meshed =
        Crown{.shape = CrownShape::mesh, .height = 0.8, .leaf_density = 2.0, .mesh = ball_mesh(12)};
    return std::vector<CasterKind>{
        {"opaque", {}},
        {"transparent", {{glass}}},
        {"screen", {{mesh}}},
        {"scheduled", {{}, 0}},
        {"scheduled screen", {{mesh}, 0}},
        {"crown", {{crown}}},
        {"meshed crown", {{meshed}}},
    };
  }();
  return kinds;
}

inline CasterKind const& caster_kind(std::string_view name) {
  return *std::find_if(caster_kinds().begin(), caster_kinds().end(),
                       [&](CasterKind const& kind) { return kind.name == name; });
}

// The rectangle around an outline, along its first edge.
inline Polygon rectangle_around(Ring const& ring) {
  glm::dvec3 const up = normal({ring, {}});
  glm::dvec3 const u = glm::normalize(ring[1] - ring[0]);
  glm::dvec3 const v = glm::cross(up, u);
  glm::dvec2 low(0.0);
  glm::dvec2 high(0.0);
  for (glm::dvec3 const& vertex : ring) {
    glm::dvec2 const place(glm::dot(vertex - ring[0], u), glm::dot(vertex - ring[0], v));
    low = glm::min(low, place);
    high = glm::max(high, place);
  }
  return parallelogram(ring[0] + low.x * u + low.y * v, (high.x - low.x) * u, (high.y - low.y) * v);
}

// Makes a surface a caster of a kind.
inline void finish(Surface& surface, CasterKind const& kind, int schedule) {
  if (kind.filter.find<Crown>() != nullptr) {
    surface.polygon = rectangle_around(surface.polygon.outline);
  }
  surface.filter = kind.filter;
  if (kind.filter.schedule >= 0) surface.filter.schedule = schedule;
}

// A random scene on a site with others.
struct Lot {
  SurfaceId receiver = 0;
  std::vector<SurfaceId> casters;
  SunDirection sun;
};

// Adds random scenes side by side, each 50 m east of the one before. Two of three casters are of
// the kind, and the others are opaque.
inline std::vector<Lot> add_lots(Scene& scene, std::uint32_t count, CasterKind const& kind) {
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
