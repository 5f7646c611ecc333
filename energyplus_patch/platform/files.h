#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace gpu_shading::energyplus {

// Throws Error: "FILE: no such file", "FILE: is a link to a file that does not exist", or "FILE: is
// not a file", as folders are and pipes and devices, which may never come to an end.
void require_file(std::filesystem::path const& path);

// The contents of a file. Throws Error like require_file(), "FILE: cannot be read" or "FILE: is
// larger than 1 GiB".
inline constexpr std::uintmax_t most_text_bytes = std::uintmax_t{1} << 30U;
std::string read_text_file(std::filesystem::path const& path);

// Replaces a file as a whole: see StagedFiles. Throws Error: "FILE: cannot be written (why)".
void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write);

}  // namespace gpu_shading::energyplus
