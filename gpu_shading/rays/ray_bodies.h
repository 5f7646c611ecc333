#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "filters/crown/crowns.h"
#include "filters/perforation/sheet_rays.h"
#include "filters/transmission.h"
#include "gpu_shading/rays.h"
#include "rays/mesh_path.h"
#include "rays/ray_shapes.h"
#include "rays/ray_tree.h"

namespace gpu_shading {

inline double at_or_one(std::span<double const> values, int index) {
  auto const place = static_cast<std::size_t>(index);
  return place < values.size() ? values[place] : 1.0;
}

// Perforated sheets as rays meet them: between their two faces, as the renderer draws them. Numbers
// are those of Screens.
class RayScreens {
 public:
  // Those of `casters`. Screens must outlive it.
  RayScreens(Screens const& screens, std::span<SurfaceId const> casters, ScreenDetail detail)
      : screens_(screens), detail_(detail) {
    std::vector<Box> boxes(screens_.entries().size());
    surfaces_.resize(boxes.size());
    for (SurfaceId const id : casters) {
      int const number = screens_.number(id);
      if (number == Screens::none) continue;
      auto const place = static_cast<std::size_t>(number);
      boxes[place] = bounds_of(screens_[number]);
      surfaces_[place] = id;
      PerforatedScreen const& screen = *screens_[number].screen;
      if (!by_holes(screen) && !screen.pattern()) screen.transmittance();
    }
    tree_ = RayTree(boxes);
  }

  // Calls met(surface, distance, transmittance) for the sheets that a ray meets no farther than at
  // `limit`, which `met` may change, unless skips(surface).
  template <typename Skips, typename Met>
  void search(RayPath const& ray, double const& limit, std::span<double const> deployments,
              Skips const& skips, Met const& met) const {
    tree_.search(ray, limit, [&](std::uint32_t place) {
      auto const number = static_cast<int>(tree_.order()[place]);
      SurfaceId const surface = surfaces_[static_cast<std::size_t>(number)];
      if (skips(surface)) return;
      Screens::Entry const& entry = screens_[number];
      auto const sheet = meet_sheet(entry, {ray.origin, ray.direction, ray.length, limit, on_plane},
                                    by_holes(*entry.screen));
      if (!sheet) return;
      double const deployed = entry.deployment < 0 ? 1.0 : at_or_one(deployments, entry.deployment);
      met(surface, sheet->distance, 1.0 - deployed * (1.0 - sheet->passed));
    });
  }

 private:
  static Box bounds_of(Screens::Entry const& entry) {
    Box box;
    for (Screens::Quadrilateral const& part : entry.parts) {
      for (glm::dvec3 const& corner : part.corners) {
        box.include(corner + entry.inside * entry.normal);
        box.include(corner + entry.outside * entry.normal);
      }
    }
    return with_margin(box);
  }

  bool by_holes(PerforatedScreen const& screen) const {
    return ScreenDetail::holes ==
           (detail_ == ScreenDetail::automatic ? screen.sheet().detail : detail_);
  }

  Screens const& screens_;
  ScreenDetail detail_;
  std::vector<SurfaceId> surfaces_;  // by number
  RayTree tree_;
};

class RayCrowns {
 public:
  RayCrowns(Crowns const& crowns, std::span<SurfaceId const> casters) : crowns_(crowns) {
    std::vector<Box> boxes(crowns_.entries().size());
    for (SurfaceId const id : casters) {
      int const number = crowns_.number(id);
      if (number == Crowns::none) continue;
      Box& box = boxes[static_cast<std::size_t>(number)];
      for (glm::dvec3 const& corner : crowns_[number].corners()) box.include(corner);
      box = with_margin(box);
      if (crowns_[number].crown.mesh) meshes_.try_emplace(number, crowns_[number]);
    }
    tree_ = RayTree(boxes);
  }

  // As RayScreens. The distance is that at which a ray enters a crown; the part of its path that
  // counts ends where the ray does.
  template <typename Skips, typename Met>
  void search(RayPath const& ray, double const& limit, std::span<double const> deployments,
              Skips const& skips, Met const& met) const {
    tree_.search(ray, limit, [&](std::uint32_t place) {
      auto const number = static_cast<int>(tree_.order()[place]);
      Crowns::Entry const& crown = crowns_[number];
      if (skips(crown.surface)) return;
      if (crown.crown.mesh) {
        MeshPaths::Path const path = meshes_.at(number)(ray);
        if (path.length == 0.0 || path.begin > limit) return;
        met(crown.surface, path.begin,
            std::exp(-crown.extinction(ray.direction, deployments) * path.length));
        return;
      }
      RayPart part = crown.solid.inside(crown.in_cube(ray.origin - crown.centre),
                                        crown.in_cube(ray.direction));
      part = {std::max(part.begin, 0.0), std::min(part.end, ray.length)};
      if (part.length() == 0.0 || part.begin > limit) return;
      double const extinction = crown.extinction(ray.direction, deployments);
      met(crown.surface, part.begin, std::exp(-extinction * part.length()));
    });
  }

 private:
  Crowns const& crowns_;
  std::map<int, MeshPaths> meshes_;  // by number
  RayTree tree_;
};

// Casters that are not flat, of all kinds, as rays meet them.
class RayBodies {
 public:
  // Those of `casters`. The transmission must outlive it.
  RayBodies(Transmission const& transmission, std::span<SurfaceId const> casters,
            RayOptions const& options)
      : screens_(transmission.screens(), casters, options.screens),
        crowns_(transmission.crowns(), casters) {}

  // Calls met(surface, distance, transmittance) for those that a ray meets no farther than at
  // `limit`, which `met` may change, unless skips(surface).
  template <typename Skips, typename Met>
  void search(RayPath const& ray, double const& limit, std::span<double const> deployments,
              Skips const& skips, Met const& met) const {
    screens_.search(ray, limit, deployments, skips, met);
    crowns_.search(ray, limit, deployments, skips, met);
  }

 private:
  RayScreens screens_;
  RayCrowns crowns_;
};

}  // namespace gpu_shading
