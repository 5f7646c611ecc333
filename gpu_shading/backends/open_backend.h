#pragma once

#include <memory>

#include "gpu_shading/device.h"
#include "view/picture_raster.h"
#include "view/view_backend.h"

namespace gpu_shading {

// The back end for a device. OpenGL is loaded for a device by its index, and to look for a GPU.
// Throws DeviceError if the device is not available.
std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& device);

// The same for pictures.
std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& device);

}  // namespace gpu_shading
