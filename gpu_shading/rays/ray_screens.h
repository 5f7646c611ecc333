#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "filters/perforation/screens.h"
#include "gpu_shading/scene.h"
#include "rays/ray_path.h"
#include "rays/ray_tree.h"

namespace gpu_shading {

// Perforated sheets as rays meet them: between their two faces, as the renderer draws them. Numbers
// are those of Screens.
class RayScreens {
 public:
  // Those of `casters`.
  RayScreens(Scene const& scene, std::span<SurfaceId const> casters, ScreenDetail detail);

  struct Met {
    double distance;  // of the polygon, or else of the middle of the body
    double passed;    // 0 .. 1, of a sheet that is fully deployed
  };

  // Calls look(surface, number) for the sheets that a ray may meet no farther than at `limit`,
  // which `look` may change.
  template <typename Look>
  void search(RayPath const& ray, double const& limit, Look const& look) const {
    tree_.search(ray, limit, [&](std::uint32_t place) {
      int const number = static_cast<int>(tree_.order()[place]);
      look(surfaces_[static_cast<std::size_t>(number)], number);
    });
  }

  std::optional<Met> meet(int number, RayPath const& ray, double limit) const;

  // Surface::deployment.
  int deployment(int number) const { return screens_[number].deployment; }

 private:
  bool by_holes(PerforatedScreen const& screen) const;

  Screens screens_;
  ScreenDetail detail_;
  std::vector<SurfaceId> surfaces_;  // by number
  RayTree tree_;
};

}  // namespace gpu_shading
