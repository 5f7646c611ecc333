#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// The version of the EnergyPlus in a folder, e.g. "25.2.0", from the first line of its Energy+.idd,
// or from its library's name where it has none.
// Throws Error.
std::string read_version(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
