#pragma once

#include <memory>

#include "gpu_shading/perforated_screen.h"
#include "gpu_shading/scene.h"
#include "gpu_shading/transmittance.h"

// What the pointers of calls.h point to.
namespace gpu_shading::python {

struct FilterObject {
  FilterFactor factor;
};

struct ScreenObject {
  std::shared_ptr<PerforatedScreen const> screen;
};

struct SceneObject {
  Scene scene;
};

}  // namespace gpu_shading::python
