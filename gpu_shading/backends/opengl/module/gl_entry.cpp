#include <optional>
#include <utility>

#include "backends/opengl/egl/device.h"
#include "backends/opengl/module/gl_module.h"
#include "backends/opengl/raster/gl_backend.h"
#include "backends/opengl/raster/gl_picture_raster.h"

namespace gpu_shading {
namespace {

class Module : public DeviceModule {
 public:
  std::vector<DeviceInfo> list_devices(std::vector<std::string>& failures) const override {
    egl::DeviceWalk walk;
    std::vector<DeviceInfo> devices;
    while (std::optional<egl::Device> const device = walk.next()) devices.push_back(device->info);
    failures.insert(failures.end(), walk.failures().begin(), walk.failures().end());
    return devices;
  }

  std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                    DeviceChoice const& choice) const override {
    std::optional<egl::Device> device = egl::open(choice);
    if (!device) return nullptr;
    return std::make_unique<GlBackend>(std::move(*device), input);
  }

  std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                   DeviceChoice const& choice) const override {
    std::optional<egl::Device> device = egl::open(choice);
    if (!device) return nullptr;
    return std::make_unique<GlPictureRaster>(std::move(*device), scene);
  }
};

}  // namespace
}  // namespace gpu_shading

extern "C" [[gnu::visibility("default")]] gpu_shading::DeviceModule const* GPU_SHADING_GL_MODULE() {
  static gpu_shading::Module const module;
  return &module;
}
