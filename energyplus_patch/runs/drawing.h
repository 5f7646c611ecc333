#pragma once

#include <istream>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// A surface as EnergyPlus draws it, with EnergyPlus's name and vertices in world axes.
struct DrawnSurface {
  std::string name;
  Ring outline;
};

// The surfaces in an eplusout.dxf from Output:Surfaces:Drawing, DXF:WireFrame, the only output with
// every surface's vertices, to five decimals of a metre. Mirrored shading surfaces ("Mir-...") are
// left out. Throws Error if it is not such a file, or is incomplete.
std::vector<DrawnSurface> read_drawing(std::istream& dxf);

// A model's surfaces as EnergyPlus passes them to its pixel counting: windows and doors are holes
// in their walls, and a window set back from its wall by a millimetre or more has a reveal along
// each edge, "NAME reveal N".
std::vector<Surface> surfaces_of(std::vector<DrawnSurface> const& drawing,
                                 ShadingInput const& input);

// Whether a surface is a wall, roof, floor, window or door exposed to the outdoors.
bool is_exterior(std::string const& surface, ShadingInput const& input);

}  // namespace gpu_shading::energyplus
