#pragma once

#include <filesystem>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Writes a picture by OpenImageIO, in the format of the path's extension. OpenImageIO and its
// libraries are loaded at the first call (about 0.25 s), from libgpu_shading_images.so beside this
// module. Throws Error.
void write_image(std::filesystem::path const& path, Image const& image);

}  // namespace gpu_shading::energyplus
