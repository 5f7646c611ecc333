#pragma once

#include <filesystem>
#include <vector>

#include "images/image_library.h"

namespace gpu_shading::energyplus {

// A GeoTIFF by its header, and its elevations in metres, rows as in the file. They throw Error:
// why, in one line; the file is for the caller to name.
gpu_shading_elevation_info probe_elevations(std::filesystem::path const& path);
std::vector<double> read_elevations(std::filesystem::path const& path,
                                    gpu_shading_elevation_info const& info);

}  // namespace gpu_shading::energyplus
