#pragma once

#include <filesystem>
#include <vector>

#include "image_plugin/image_plugin.h"

namespace gpu_shading::energyplus {

// The header of a GeoTIFF, and its elevations in metres with rows as in the file. Both throw Error
// with the reason in one line, to which the caller adds the file's name.
gpu_shading_elevation_info probe_elevations(std::filesystem::path const& path);
std::vector<double> read_elevations(std::filesystem::path const& path,
                                    gpu_shading_elevation_info const& info);

}  // namespace gpu_shading::energyplus
