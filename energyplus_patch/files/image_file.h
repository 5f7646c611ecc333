#pragma once

#include <string>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// A picture as the bytes of a file, by OpenImageIO; the ending of `name` is its format. Throws
// Error: "NAME: cannot be drawn: why".
std::string encode_image(std::string const& name, Image const& image);

}  // namespace gpu_shading::energyplus
