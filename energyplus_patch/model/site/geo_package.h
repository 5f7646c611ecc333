#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "model/site/geojson.h"

namespace gpu_shading::energyplus::geojson {

// The features of a layer of a GeoPackage, as GeoJSON has them, numbered by their primary keys. The
// layer may be left empty if there is only one.
// With a circle, the R-tree of the layer is asked, so that only features near the circle are read.
// Throws Error without the file's name.
MapCoordinates read_geo_package(std::filesystem::path const& path, std::string const& layer,
                                std::optional<MapCoordinates> const& coordinates,
                                std::optional<Nearby> const& nearby, UseFeature const& use);

}  // namespace gpu_shading::energyplus::geojson
