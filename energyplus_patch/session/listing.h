#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/model_reader.h"

namespace gpu_shading::energyplus {

// A table of what each surface is to the shading calculation: kind, area, whether its own sunlit
// fraction is rendered, how it casts; below a screened one, where the screen's tile lies; before
// all what lean input did and what surroundings were read, if any. `wanted`: by surface of
// EnergyPlus's; those after them are not in its input: first what was left out of it, then the
// surroundings, of which a mesh has one row and neighbouring buildings and terrain have none.
std::string list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted);

// The outlines of the same surfaces, one vertex a line, as comma-separated values.
std::string list_vertices(Scene const& scene, Model const& model);

}  // namespace gpu_shading::energyplus
