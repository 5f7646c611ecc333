#pragma once

#include <map>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// Shading surfaces in EnergyPlus's input from which EnergyPlus deletes vertices within 1 cm of each
// other: it would make a triangle of a slat of 4 mm.
struct SimplifiedSurfaces {
  std::map<std::string, Ring> outlines;  // as the model gives them, by EnergyPlus's names
  std::string warning;                   // which surfaces, in EnergyPlus's words; "" if none
};

// Detailed shading surfaces, without those that are left out of EnergyPlus's input. Never throws:
// what cannot be interpreted is EnergyPlus's to report.
SimplifiedSurfaces find_simplified_surfaces(std::vector<InputObject> const& objects,
                                            ShadingInput const& input, Names const& left_out);

}  // namespace gpu_shading::energyplus
