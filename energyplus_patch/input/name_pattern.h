#pragma once

#include <string_view>

namespace gpu_shading::energyplus {

// Whether a name matches a pattern, in which * stands for any run of characters; without regard to
// case.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace gpu_shading::energyplus
