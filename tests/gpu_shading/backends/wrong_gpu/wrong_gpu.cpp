#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/cpu/cpu_backend.h"
#include "backends/cpu/cpu_picture_raster.h"
#include "backends/opengl/module/gl_module.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

DeviceInfo wrong_gpu() {
  DeviceInfo info;
  info.id = numbered_device(0);
  info.renderer = "Wrong GPU";
  info.vendor = "Nobody";
  info.version = "4.5 (wrong driver 0.1)";
  info.max_resolution = 16384;
  return info;
}

// Loses a tenth of what opaque casters leave; all else is as on the CPU.
class WrongBackend : public ViewBackend {
 public:
  explicit WrongBackend(BackendInput const& input) : info_(wrong_gpu()), cpu_(input) {}

  DeviceInfo const& device() const override { return info_; }

  void add(std::vector<ReceiverView> views) override {
    for (ReceiverView& view : views) {
      wrong_.push_back(!view.transmits && !view.through);
      view.at_pixels = true;
    }
    cpu_.add(std::move(views));
  }

  std::vector<ViewSums> finish() override {
    std::vector<ViewSums> sums = cpu_.finish();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (wrong_[i]) sums[i].parts.front().unscheduled *= 0.9;
    }
    wrong_.clear();
    return sums;
  }

  void forget() override {
    wrong_.clear();
    cpu_.forget();
  }

 private:
  DeviceInfo info_;
  CpuBackend cpu_;
  std::vector<bool> wrong_;  // by view of the batch
};

class Module : public DeviceModule {
 public:
  std::vector<DeviceInfo> list_devices(std::vector<std::string>& /*failures*/) const override {
    return {wrong_gpu()};
  }
  std::unique_ptr<ViewBackend> open(BackendInput const& input,
                                    DeviceChoice const& device) const override {
    if (device.device.value_or(wrong_gpu().id) != wrong_gpu().id)
      throw DeviceError("there is one device");
    return std::make_unique<WrongBackend>(input);
  }
  std::unique_ptr<PictureRaster> open_for_pictures(PictureScene const& scene,
                                                   DeviceChoice const& /*device*/) const override {
    return std::make_unique<CpuPictureRaster>(scene);
  }
};

}  // namespace
}  // namespace gpu_shading

extern "C" [[gnu::visibility("default")]] gpu_shading::DeviceModule const* GPU_SHADING_GL_MODULE() {
  static gpu_shading::Module const module;
  return &module;
}
