#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// An exterior surface that the sun can reach, or a window or door in one.
struct ExposedSurface {
  InputObject const* object = nullptr;
  // (1 - cos(tilt)) / 2; NaN if its tilt cannot be read, or EnergyPlus may change it.
  double ground_view = 0.5;
};

// By EnergyPlus's names, without those that several objects have. Empty for invalid
// GlobalGeometryRules, which EnergyPlus reports. Never throws.
std::map<std::string, ExposedSurface> exposed_surfaces(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
