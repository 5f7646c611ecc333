#pragma once

#include <string>

#include "gpu_shading/image.h"
#include "gpu_shading/scene_view.h"

namespace gpu_shading::energyplus {

// An image of 3 channels with an arrow to the north in its lower left corner and a bar of a round
// length beside it, as the bytes of a file; the ending of `name` is its format. Throws Error.
std::string encode_with_marks(std::string const& name, Image image, ViewScale const& scale);

}  // namespace gpu_shading::energyplus
