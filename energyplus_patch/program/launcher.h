#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The energyplus beside this program. Throws Error where that is no folder of patch_energyplus.
std::filesystem::path find_launcher();

}  // namespace gpu_shading::energyplus
