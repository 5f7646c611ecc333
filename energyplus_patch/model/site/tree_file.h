#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/local_axes.h"
#include "gpu_shading/map_coordinates.h"

namespace gpu_shading::energyplus {

// A tree in a file; its elevation is that of the terrain.
struct MappedTree {
  std::string name;  // of its feature
  GeographicPoint place;
  // If the feature has them; in m.
  std::optional<double> height;
  std::optional<double> crown_diameter;
  std::optional<bool> evergreen;
  std::string taxon;  // its genus or species, or ""
};

struct TreeFile {
  std::vector<MappedTree> trees;
  std::size_t others = 0;  // features that are no points
};

// Reads GeoJSON: Point and MultiPoint features, as OpenStreetMap has natural=tree. `coordinates`:
// as for read_buildings. Throws Error: "FILE: feature 3 (node/17): ...".
TreeFile read_tree_file(std::filesystem::path const& path,
                        std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
