#pragma once

#include <memory>

#include "gpu_shading/device.h"
#include "gpu_shading/renderer.h"
#include "view/picture_raster.h"
#include "view/view_backend.h"

namespace gpu_shading {

// The back end for the device of the options. OpenGL is loaded for a device by its index, and to
// look for a GPU. Throws DeviceError when the device cannot be had.
std::unique_ptr<ViewBackend> open_backend(BackendInput const& input,
                                          RendererOptions const& options);

// The same for pictures.
std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& device);

}  // namespace gpu_shading
