#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The path of a file of ours beside the module or program that this code is part of.
std::filesystem::path sibling_file(char const* name);

// What installs a reader or writer of files that is not there, in parentheses; "" if it is there.
std::string formats_package(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
