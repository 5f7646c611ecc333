#pragma once

#include <filesystem>
#include <optional>

#include "gpu_shading/terrain.h"

namespace gpu_shading::energyplus {

// Of more nodes the ground is not drawn: a million take a gigabyte.
inline constexpr int max_terrain_nodes = 1'000'000;

// Throws Error where the ground would be too large, or no ground.
void check_terrain_size(int columns, int rows);

// Reads a GeoTIFF (see geotiff.h) or an ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter,
// yllcorner or yllcenter, cellsize (or dx and dy), NODATA_value (-9999 where it is absent), then
// elevations in metres, rows from the north. Nodes are the cells' centres. `coordinates`: nothing:
// as a GeoTIFF says, WGS84 of an ASCII grid. Throws Error: "FILE: why", one line.
TerrainGrid read_terrain(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
