#pragma once

#include <memory>

#include "backends/checked/checked_backend.h"
#include "backends/interface/picture_raster.h"
#include "backends/interface/view_backend.h"
#include "gpu_shading/device.h"

namespace gpu_shading {

// The back end for a device. Only the modules that may have it are loaded. `warn` is told why a GPU
// that is there cannot be used where another device is opened instead. Throws DeviceError if the
// chosen device is not available.
std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& choice,
                                          Warn const& warn = {});

// The same; a device other than the CPU is checked (CheckedBackend), and leaves to the CPU what it
// cannot draw (SheetPairsOnCpu).
std::unique_ptr<ViewBackend> open_checked_backend(BackendInput const& input,
                                                  DeviceChoice const& choice, Warn const& warn);

// The same as open_backend() for pictures.
std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& choice);

}  // namespace gpu_shading
