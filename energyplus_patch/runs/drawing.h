#pragma once

#include <istream>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"

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

}  // namespace gpu_shading::energyplus
