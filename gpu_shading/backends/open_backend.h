#pragma once

#include <memory>

#include "backends/checked/checked_backend.h"
#include "backends/interface/picture_raster.h"
#include "backends/interface/view_backend.h"
#include "gpu_shading/device.h"

namespace gpu_shading {

// The back end for a device. OpenGL is loaded for a device by its index, and to look for a GPU.
// Throws DeviceError if the device is not available.
std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& device);

// The same, with an OpenGL device whose answers are checked (CheckedBackend), and which leaves to
// the CPU what it cannot draw (SheetPairsOnCpu). `warn` is also told why a GPU that is there cannot
// be used.
std::unique_ptr<ViewBackend> open_checked_backend(BackendInput const& input,
                                                  DeviceChoice const& device, Warn const& warn);

// The same as open_backend() for pictures.
std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& device);

}  // namespace gpu_shading
