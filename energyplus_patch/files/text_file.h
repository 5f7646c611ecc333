#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// The whole of a file. Throws Error: "FILE: no such file", "... is not a file", "... cannot be
// read".
std::string read_text_file(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
