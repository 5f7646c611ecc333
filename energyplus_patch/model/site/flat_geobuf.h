#pragma once

#include <filesystem>
#include <optional>

#include "model/site/geojson.h"

namespace gpu_shading::energyplus::geojson {

bool is_flat_geobuf(std::filesystem::path const& path);

// The features of a FlatGeobuf file (version 3), as GeoJSON has them, numbered by their order in
// the file. With a circle, its index of bounding boxes is asked, so that only features near the
// circle are read. Throws Error without the file's name.
MapCoordinates read_flat_geobuf(std::filesystem::path const& path,
                                std::optional<MapCoordinates> const& coordinates,
                                std::optional<Nearby> const& nearby, UseFeature const& use);

}  // namespace gpu_shading::energyplus::geojson
