#pragma once

#include <istream>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading::energyplus {

// A surface as EnergyPlus draws it: name as EnergyPlus has it, vertices in world axes.
struct DrawnSurface {
  std::string name;
  Ring outline;
};

// The surfaces of an eplusout.dxf that Output:Surfaces:Drawing, DXF:WireFrame makes: the one output
// with every surface's vertices, to five decimals of a metre. Mirrored shading surfaces ("Mir-...")
// are left out. Throws Error where it is not such a file, or ends early.
std::vector<DrawnSurface> read_drawing(std::istream& dxf);

}  // namespace gpu_shading::energyplus
