#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "gpu_shading/scene.h"

namespace gpu_shading::energyplus {

// The extent of casters along the world axes.
class Extent {
 public:
  void include(Ring const& ring);

  // Distance in plan from the origin of the world axes to the bounding box; 0 if there are none.
  double distance() const;

  // "x -12.0 to 30.5, y 0.0 to 8.0, z 0.0 to 12.0 m".
  std::string describe() const;

 private:
  bool empty_ = true;
  glm::dvec3 low_{0.0};
  glm::dvec3 high_{0.0};
};

}  // namespace gpu_shading::energyplus
