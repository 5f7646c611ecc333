#pragma once

#include <string>

#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// The scene that is rendered for a model, as JSON that the Python package reads:
// every surface with its vertices, optics and part in the shading rule, in the
// order of the scene. Transmittances are given at each half degree, textures as hexadecimal digits.
// Throws Error for a texture of more than 4096 x 4096 texels.
std::string scene_document(SceneAssembly& scene);

}  // namespace gpu_shading::energyplus
