#pragma once

#include <string>
#include <vector>

#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// A line for each length of an extension object above anything that is built: it may have been
// meant in millimetres, centimetres or inches.
std::vector<std::string> warn_of_lengths(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
