#pragma once

#include <filesystem>
#include <string>

#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// The version of the EnergyPlus in a folder, e.g. "9.6.0", from the first line of its Energy+.idd
// or, without that, from its library's name. Throws Error.
std::string read_version(std::filesystem::path const& folder);

// As EnergyPlus states it: with the build of its Energy+.idd, e.g. "9.6.0-0123456789". Throws
// Error.
std::string read_full_version(std::filesystem::path const& folder);

// The same version, and how to update models to it. Throws Error like read_version().
Release read_release(std::filesystem::path const& folder);

// EnergyPlus's library for a patched folder, through its link to the official one. Throws Error.
std::filesystem::path find_energyplus_library(std::filesystem::path const& folder);

// What a user does about a file of the official installation that a patched folder links to and
// that is gone: pip reinstalls the package of PyPI that has it.
std::string how_to_restore(std::filesystem::path const& official);

// The official library, for one of ours that stands before it in a patched folder; otherwise
// `library` itself. Links are followed.
std::filesystem::path official_behind(std::filesystem::path const& library);

// The energyplus beside this program. Throws Error if it is not in a folder created by
// patch_energyplus.
std::filesystem::path find_launcher();

}  // namespace gpu_shading::energyplus
