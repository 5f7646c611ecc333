#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/interface/picture_raster.h"
#include "backends/interface/view_backend.h"
#include "gpu_shading/device.h"

namespace gpu_shading {

// The devices of one API, such as OpenGL, and the back ends that use them.
class DeviceModule {
 public:
  DeviceModule() = default;
  virtual ~DeviceModule() = default;
  DeviceModule(DeviceModule const&) = delete;
  DeviceModule& operator=(DeviceModule const&) = delete;
  DeviceModule(DeviceModule&&) = delete;
  DeviceModule& operator=(DeviceModule&&) = delete;

  // All devices, in the order of their numbers. `failures` gets one line for each that cannot be
  // used.
  virtual std::vector<DeviceInfo> list_devices(std::vector<std::string>& failures) const = 0;

  // Opens the chosen device, which is one of this module, or else its first GPU; null if it has
  // none. Throws DeviceError if the device is not available.
  virtual std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                            DeviceChoice const& choice) const = 0;

  // The same for pictures.
  virtual std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                           DeviceChoice const& choice) const = 0;
};

}  // namespace gpu_shading
