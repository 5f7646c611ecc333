#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// The folder of the running program: a patched EnergyPlus, for the launcher and the gpu_shading
// program.
std::filesystem::path own_folder();

}  // namespace gpu_shading::energyplus
