#pragma once

#include <filesystem>
#include <optional>

#include "model/site/geojson.h"

namespace gpu_shading::energyplus::geojson {

// The features of a GeoPackage with one layer, as GeoJSON has them, numbered by their primary keys.
// With a circle, the R-tree of the layer is asked, so that only features near the circle are read.
// Throws Error without the file's name.
MapCoordinates read_geo_package(std::filesystem::path const& path,
                                std::optional<MapCoordinates> const& coordinates,
                                std::optional<Nearby> const& nearby, UseFeature const& use);

}  // namespace gpu_shading::energyplus::geojson
