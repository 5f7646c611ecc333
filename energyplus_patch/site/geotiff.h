#pragma once

#include <filesystem>
#include <optional>

#include "gpu_shading/terrain.h"

namespace gpu_shading::energyplus {

// By its first bytes.
bool is_tiff(std::filesystem::path const& path);

// Reads a GeoTIFF of one channel of elevations in metres, up to max_terrain_nodes of them, whose
// rows run east or west. `coordinates`: nothing: as the file says, which has to be WGS84 or UTM.
// Throws Error: why, in one line.
TerrainGrid read_geotiff(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
