#pragma once

#include <filesystem>

namespace gpu_shading::energyplus {

// These return 0, or the errno of what failed.

// Whether entries of a folder can be read, written and made.
int find_access(std::filesystem::path const& folder);

// Puts what was written on the disk. Some file systems have nothing to flush, and say so: that is
// no failure.
int flush_file(std::filesystem::path const& file);
int flush_folder(std::filesystem::path const& folder);

// Renames a file, which replaces another in one step, or a folder, which may replace an empty one.
int replace_file(std::filesystem::path const& file, std::filesystem::path const& replaced);

}  // namespace gpu_shading::energyplus
