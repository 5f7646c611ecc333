#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The path of a file of ours beside the module or program that this code is part of.
std::filesystem::path beside_this_code(char const* name);

}  // namespace gpu_shading::energyplus
