#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace gpu_shading::energyplus {

// Why a run stopped, from the eplusout.err in its folder: "Severe: ...; Fatal: ...".
std::string stop_reasons(std::filesystem::path const& folder);

// The last error of ours in what a run has printed, without "gpu_shading: error: ".
std::optional<std::string> last_error(std::filesystem::path const& log);

}  // namespace gpu_shading::energyplus
