#pragma once

#include <cstdint>
#include <span>

#include "gpu_shading/renderer.h"
#include "session/digest.h"

namespace gpu_shading::energyplus {

// What else an answer depends on, beside the scene, the sun and the shares of screens in place.
struct Rendering {
  RendererOptions const& options;
  DeviceInfo const& device;             // devices differ in the last digits
  std::span<std::uint32_t const> rule;  // the scene's shading rule, as describe_shading_rule has it
  std::span<std::byte const> build;     // build_id()
};

// Of all that an answer depends on: where hashes are equal, so are answers. Surfaces count by their
// order, not by their names; a screen by the holes it is made of; a transmittance, which is a
// function, by its values at every hundredth of a degree.
Hash hash_scene(Scene const& scene, Rendering const& rendering);

}  // namespace gpu_shading::energyplus
