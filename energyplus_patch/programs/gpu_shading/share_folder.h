#pragma once

#include <filesystem>
#include <vector>

namespace gpu_shading::energyplus {

// Where documents and examples may be that are installed with the programs, or the folder of the
// sources: that which made this patched folder first, then beside this program and in the system's
// folders.
std::vector<std::filesystem::path> share_folders();

}  // namespace gpu_shading::energyplus
