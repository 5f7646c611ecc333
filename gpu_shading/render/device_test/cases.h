#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/sun_direction.h"

namespace gpu_shading {

// A scene whose sunlit areas are known in closed form.
struct ClosedForm {
  // A receiver at one sun direction.
  struct View {
    SurfaceId receiver = 0;
    SunDirection sun;
    double whole = 0.0;             // its projected area, m2
    std::vector<SurfaceId> inside;  // surfaces behind it, if these are asked for
    std::vector<double> exact;      // sunlit area of the receiver, or of each of these, m2
  };

  std::string kind;
  Scene scene;
  std::vector<double> factors;  // of schedules
  std::vector<View> views;
};

// One of each kind of view.
std::vector<ClosedForm> closed_forms();

}  // namespace gpu_shading
