#include "backends/open_backend.h"

#include "gl_module/gl_module.h"
#include "gpu_shading/error.h"
#include "raster_cpu/cpu_backend.h"
#include "raster_cpu/cpu_picture_raster.h"

namespace gpu_shading {
namespace {

// What `open_gpu` opens, or nothing where there is no GPU, nor any OpenGL.
template <typename Open>
auto find_gpu(Open open_gpu) -> decltype(open_gpu(gl_module())) {
  try {
    return open_gpu(gl_module());
  } catch (DeviceError const&) {
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& device) {
  switch (device.kind) {
    case DeviceChoice::Kind::index:
      return gl_module().open_device(device.index, input);
    case DeviceChoice::Kind::automatic:
      if (auto gpu = find_gpu([&](GlModule const& gl) { return gl.open_gpu(input); })) {
        return gpu;
      }
      break;
    case DeviceChoice::Kind::cpu:
      break;
  }
  return std::make_unique<CpuBackend>(input);
}

std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& device) {
  switch (device.kind) {
    case DeviceChoice::Kind::index:
      return gl_module().open_device_for_pictures(device.index, scene);
    case DeviceChoice::Kind::automatic:
      if (auto gpu =
              find_gpu([&](GlModule const& gl) { return gl.open_gpu_for_pictures(scene); })) {
        return gpu;
      }
      break;
    case DeviceChoice::Kind::cpu:
      break;
  }
  return std::make_unique<CpuPictureRaster>(scene);
}

}  // namespace gpu_shading
