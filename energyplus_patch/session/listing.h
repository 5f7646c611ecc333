#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/model_reader.h"

namespace gpu_shading::energyplus {

// A table of how each surface takes part in the shading calculation: kind, area, whether its own
// sunlit fraction is rendered, and how it casts shadows; below a screen, the position of its tile.
// Before the table: what lean input did and which surroundings were read. `wanted`: by EnergyPlus's
// surfaces. The surfaces after these are not in its input: first those left out by lean input, then
// the surroundings, with one row for a mesh and none for neighbouring buildings and terrain.
std::string list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted);

// The outlines of the same surfaces, one vertex per line, as comma-separated values.
std::string list_vertices(Scene const& scene, Model const& model);

}  // namespace gpu_shading::energyplus
