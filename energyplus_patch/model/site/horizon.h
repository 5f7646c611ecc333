#pragma once

#include <array>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading::energyplus {

// What rises highest in each degree of azimuth, as seen from the origin of the world axes.
class Horizon {
 public:
  // An outline's edges, in world axes.
  void include(Ring const& outline);

  // An upright face for each degree in which something is above the origin's level, as high and as
  // far away as what is highest in the degree's middle.
  std::vector<Polygon> faces() const;

 private:
  struct Highest {
    double slope = 0.0;     // height by distance
    double distance = 0.0;  // m, in plan
  };

  void include(glm::dvec3 const& from, glm::dvec3 const& to);

  static constexpr int degrees = 360;
  std::array<Highest, degrees> highest_{};
};

}  // namespace gpu_shading::energyplus
