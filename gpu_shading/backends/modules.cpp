#include "backends/modules.h"

#include <array>

#include "backends/cpu/cpu_backend.h"
#include "backends/cpu/cpu_picture_raster.h"
#include "backends/opengl/module/gl_module.h"

namespace gpu_shading {
namespace {

class CpuModule : public DeviceModule {
 public:
  std::vector<DeviceInfo> list_devices(std::vector<std::string>& /*failures*/) const override {
    return {cpu_device()};
  }
  std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                    DeviceChoice const& /*choice*/) const override {
    return std::make_unique<CpuBackend>(input);
  }
  std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                   DeviceChoice const& /*choice*/) const override {
    return std::make_unique<CpuPictureRaster>(scene);
  }
};

DeviceModule const& cpu_module() {
  static CpuModule const module;
  return module;
}

constexpr std::array modules{
    NamedModule{"opengl", gl_module},
    NamedModule{"cpu", cpu_module},
};

}  // namespace

std::span<NamedModule const> device_modules() { return modules; }

}  // namespace gpu_shading
