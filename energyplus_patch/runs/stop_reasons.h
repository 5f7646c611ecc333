#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// The lines of eplusout.err in a run's folder that say why it stopped, each after a line break.
std::string stop_reasons(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
