#pragma once

#include <filesystem>
#include <string>

namespace gpu_shading::energyplus {

// Why a run stopped, from the eplusout.err in its folder: "Severe: ...; Fatal: ...".
std::string stop_reasons(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
