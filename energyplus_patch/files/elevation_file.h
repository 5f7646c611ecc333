#pragma once

#include <filesystem>
#include <vector>

#include "files/image_decoder/elevations.h"

namespace gpu_shading::energyplus {

// Reads a GeoTIFF: its header, and its elevations in metres with rows as in the file, NaN where it
// has no data; none if there are more than most_elevations. Throws Error with the reason in one
// line, to which the caller adds the file's name.
decoding::Elevations read_elevations(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
