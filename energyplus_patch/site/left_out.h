#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input/input_object.h"

namespace gpu_shading::energyplus {

// An object's Left Out Names, blank ones aside: patterns of the names, as its file has
// them, of what it shall not put up.
std::vector<std::string> read_left_out(InputObject const& object);
bool is_left_out(std::vector<std::string> const& patterns, std::string_view name);

}  // namespace gpu_shading::energyplus
