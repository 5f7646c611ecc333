#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/footprint.h"
#include "gpu_shading/map_coordinates.h"
#include "model/site/geojson.h"

namespace gpu_shading::energyplus {

// How the height of a building is determined: its height in metres, or its levels times the storey
// height, or the default.
struct HeightRule {
  std::string height;  // names of properties
  std::string levels;
  double storey;                    // m
  std::optional<double> otherwise;  // m
};

// A feature in a file of buildings: one or more areas of equal height.
struct Building {
  // Its id, or its property @id, id, osm_id or name, or its number, from 1.
  std::string name;
  std::string label;  // for messages: "feature 3 (way/17)"
  // Base and top above the ground, m.
  std::vector<Footprint> parts;
};

struct BuildingFile {
  MapCoordinates coordinates;
  std::vector<Building> buildings;
  std::size_t others = 0;  // features that are not areas
};

// Reads the Polygon and MultiPolygon features of a file (model/site/geojson.h), or those in the
// circle. The property min_height raises a building's base above the ground. Throws Error: "FILE:
// feature 3 (way/17): ...".
BuildingFile read_buildings(std::filesystem::path const& path, HeightRule const& heights,
                            std::optional<MapCoordinates> const& coordinates,
                            std::optional<geojson::Nearby> const& nearby = std::nullopt);

}  // namespace gpu_shading::energyplus
