#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/model_reader.h"

namespace gpu_shading::energyplus {

// A table of what each surface is to the shading calculation: kind, area, whether its own sunlit
// fraction is rendered, how it casts; below a screened one, where the screen's tile lies. `wanted`:
// by surface.
std::string list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted);

}  // namespace gpu_shading::energyplus
