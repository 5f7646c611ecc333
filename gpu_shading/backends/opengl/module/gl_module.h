#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/interface/picture_raster.h"
#include "backends/interface/view_backend.h"
#include "gpu_shading/device.h"

namespace gpu_shading {

// What libgpu_shading_gl.so does for us: all that needs OpenGL, EGL and libepoxy, apart from the
// library so that it runs where these are missing. Both are of one build.
class GlModule {
 public:
  GlModule() = default;
  virtual ~GlModule() = default;
  GlModule(GlModule const&) = delete;
  GlModule& operator=(GlModule const&) = delete;
  GlModule(GlModule&&) = delete;
  GlModule& operator=(GlModule&&) = delete;

  // As gpu_shading::list_devices.
  virtual std::vector<DeviceInfo> list_devices(std::vector<std::string>& failures) const = 0;

  // Opens the device of an index in list_devices(), or else the first GPU; nothing if there is no
  // GPU. Throws DeviceError if the device is not available.
  virtual std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                            DeviceChoice const& device) const = 0;

  // The same for pictures.
  virtual std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                           DeviceChoice const& device) const = 0;
};

// Loads it, once. It lies beside this program or library, or where the dynamic linker looks. Throws
// DeviceError: what it or something that it needs is missing.
GlModule const& gl_module();

}  // namespace gpu_shading
