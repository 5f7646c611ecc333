#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// Throws Error: "FILE: no such file", or "FILE: is not a file", as folders are and pipes and
// devices, which may never come to an end.
void require_file(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
