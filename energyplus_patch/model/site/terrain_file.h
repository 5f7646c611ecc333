#pragma once

#include <filesystem>
#include <optional>

#include "gpu_shading/terrain.h"

namespace gpu_shading::energyplus {

// Terrain with more nodes is refused: a million take a gigabyte.
inline constexpr int max_terrain_nodes = 1'000'000;

// Throws Error if the terrain is too large or has no cells.
void check_terrain_size(int columns, int rows);

// Reads a GeoTIFF (see below) or an ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter,
// yllcorner or yllcenter, cellsize (or dx and dy), NODATA_value (default -9999), then elevations in
// metres, rows from the north. Nodes are the centres of cells. `coordinates`: if empty, those that
// a GeoTIFF states, or WGS84 for an ASCII grid. Throws Error: "FILE: why", one line.
TerrainGrid read_terrain(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates);

// Recognised by its first bytes. Throws Error if it is not a file.
bool is_tiff(std::filesystem::path const& path);

// Reads a GeoTIFF with one channel of elevations in metres, up to max_terrain_nodes of them, whose
// rows run east or west. `coordinates`: if empty, those that the file states, which must be WGS84
// or UTM. Throws Error with the reason in one line.
TerrainGrid read_geotiff(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
