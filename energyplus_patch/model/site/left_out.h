#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// Whether one of an object's Left Out Names, which are patterns, matches a name as its file has it.
bool is_left_out(std::vector<std::string> const& patterns, std::string_view name);

}  // namespace gpu_shading::energyplus
