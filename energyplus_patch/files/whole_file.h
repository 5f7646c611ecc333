#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace gpu_shading::energyplus {

// Writes a file in one step, under another name until it is complete, so that whatever happens
// there is the whole of it or what was there before. Throws Error where it cannot be written.
void write_whole_file(std::filesystem::path const& path,
                      std::function<void(std::ostream&)> const& write);

}  // namespace gpu_shading::energyplus
