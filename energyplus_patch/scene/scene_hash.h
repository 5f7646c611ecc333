#pragma once

#include <cstddef>
#include <span>

#include "gpu_shading/renderer.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {

// What an answer depends on besides the scene, the sun and the deployed fractions of screens.
struct Rendering {
  RendererOptions const& options;
  DeviceInfo const& device;          // devices differ in the last digits
  std::span<std::byte const> build;  // build_id()
};

// A hash of everything that an answer depends on: equal hashes mean equal answers. Surfaces are
// hashed by their order, not by their names; a screen by the holes from which it is made; a
// transmittance, which is a function, by its values at every hundredth of a degree.
Hash hash_scene(Scene const& scene, Rendering const& rendering);

}  // namespace gpu_shading::energyplus
