#pragma once

#include <cstddef>
#include <span>

#include "gpu_shading/renderer.h"
#include "scene/digest.h"

namespace gpu_shading::energyplus {

// The build ID that the linker has given to the library or program with this code (--build-id),
// which changes with any byte of its code or shaders. It is read from memory, so that a build that
// replaces the file during a run has no effect. Throws Error if there is none.
std::span<std::byte const> build_id();

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
