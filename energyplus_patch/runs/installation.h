#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// The version of the EnergyPlus in a folder, e.g. "25.2.0", from the first line of its Energy+.idd
// or, without that, from its library's name. Throws Error.
std::string read_version(std::filesystem::path const& folder);

// The energyplus beside this program. Throws Error if it is not in a folder created by
// patch_energyplus.
std::filesystem::path find_launcher();

}  // namespace gpu_shading::energyplus
