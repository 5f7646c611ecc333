#pragma once

#include <vector>

#include "gpu_shading/scene.h"
#include "model/input/shading_input.h"
#include "runs/drawing.h"

namespace gpu_shading::energyplus {

// A model's surfaces as EnergyPlus passes them to its pixel counting: windows and doors are holes
// in their walls, and a window set back from its wall by a millimetre or more has a reveal along
// each edge, "NAME reveal N".
std::vector<Surface> surfaces_of(std::vector<DrawnSurface> const& drawing,
                                 ShadingInput const& input);

// Whether a surface is a wall, roof, floor, window or door exposed to the outdoors.
bool is_exterior(std::string const& surface, ShadingInput const& input);

}  // namespace gpu_shading::energyplus
