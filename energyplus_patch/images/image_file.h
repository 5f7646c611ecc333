#pragma once

#include <filesystem>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Writes a picture by OpenImageIO, in the format of the path's extension. Throws Error.
void write_image(std::filesystem::path const& path, Image const& image);

}  // namespace gpu_shading::energyplus
