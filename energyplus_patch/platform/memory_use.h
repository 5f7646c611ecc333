#pragma once

#include <string>

namespace gpu_shading::energyplus {

// That memory has run out, how much is in use and how much may be, as far as the system says.
std::string describe_lack_of_memory();

}  // namespace gpu_shading::energyplus
