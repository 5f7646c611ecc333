#pragma once

#include <filesystem>
#include <optional>

#include "gpu_shading/terrain.h"

namespace gpu_shading::energyplus {

// Recognised by its first bytes. Throws Error if it is not a file.
bool is_tiff(std::filesystem::path const& path);

// Reads a GeoTIFF with one channel of elevations in metres, up to max_terrain_nodes of them, whose
// rows run east or west. `coordinates`: if empty, those that the file states, which must be WGS84
// or UTM. Throws Error with the reason in one line.
TerrainGrid read_geotiff(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
