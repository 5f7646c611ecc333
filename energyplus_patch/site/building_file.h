#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/footprint.h"
#include "gpu_shading/map_coordinates.h"

namespace gpu_shading::energyplus {

// How tall a building is: its height in metres; else its levels times a storey's height; else the
// default.
struct HeightRule {
  std::string height = "height";  // names of properties
  std::string levels = "building:levels";
  double storey = 3.0;  // m
  std::optional<double> otherwise = std::nullopt;
};

// A feature of a file of buildings: one or more areas of one height.
struct Building {
  // Its id, else its property @id, id, osm_id or name; else the feature's number, from 1.
  std::string name;
  std::string label;  // for messages: "feature 3 (way/17)"
  // Base and top above the ground there, m.
  std::vector<Footprint> parts;
};

struct BuildingFile {
  MapCoordinates coordinates;
  std::vector<Building> buildings;
  std::size_t others = 0;  // features that are no areas
};

// Reads GeoJSON (RFC 7946): Polygon and MultiPolygon features of a FeatureCollection, or one
// feature or geometry. `coordinates`: none takes those that the file names (the older "crs"
// member), else WGS84. The property min_height lifts a building's base off the ground. Throws
// Error: "FILE: feature 3 (way/17): ...".
BuildingFile read_buildings(std::filesystem::path const& path, HeightRule const& heights,
                            std::optional<MapCoordinates> const& coordinates);

}  // namespace gpu_shading::energyplus
