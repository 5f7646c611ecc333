#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The path of a file in the folder of the module or program that this code is part of. Throws
// Error.
std::filesystem::path sibling_file(char const* name);

// In parentheses, how to install a missing reader or writer of files; "" if it is there.
std::string formats_package(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
