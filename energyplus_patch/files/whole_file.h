#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace gpu_shading::energyplus {

// The end of an unfinished file's name, which begins as the file's.
inline constexpr std::string_view unfinished_ending = ".tmp";

// Writes a file in one step, under another name until it is complete, so that whatever happens
// there is the whole of it or what was there before. Throws Error: "FILE: cannot be written (why)".
void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write);

}  // namespace gpu_shading::energyplus
