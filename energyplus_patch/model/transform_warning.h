#pragma once

#include <string>
#include <vector>

#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// GeometryTransform moves the vertices of a model in relative coordinates, but EnergyPlus
// keeps the areas of before, by which it divides sunlit areas, and in zones that are turned the
// azimuths of before, by which it computes angles of incidence. Describes that, or returns "" for a
// model that it does not concern.
std::string warn_of_transform(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
