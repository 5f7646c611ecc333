#include "backends/open_backend.h"

#include <fmt/format.h>

#include <utility>

#include "backends/checked/checked_backend.h"
#include "backends/cpu/cpu_backend.h"
#include "backends/cpu/cpu_picture_raster.h"
#include "backends/opengl/module/gl_module.h"
#include "backends/opengl/module/gpu_presence.h"
#include "backends/sheet_pairs_on_cpu.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

GlModule const* find_gl_module() {
  try {
    return &gl_module();
  } catch (DeviceError const&) {
    return nullptr;
  }
}

// What `open` opens by OpenGL; nothing if the choice leaves it to the CPU.
template <typename Open>
auto open_by_opengl(DeviceChoice const& choice, Warn const& warn, Open open)
    -> decltype(open(gl_module())) {
  if (choice.kind == DeviceChoice::Kind::cpu) return nullptr;
  if (choice.kind == DeviceChoice::Kind::index) return open(gl_module());
  if (!may_have_gpu()) return nullptr;
  GlModule const* const gl = find_gl_module();
  if (gl == nullptr) return nullptr;
  try {
    return open(*gl);
  } catch (DeviceError const& error) {
    if (warn) warn(fmt::format("the GPU cannot be used: {}", error.what()));
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& device) {
  auto opened =
      open_by_opengl(device, {}, [&](GlModule const& gl) { return gl.open(input, device); });
  return opened ? std::move(opened) : std::make_unique<CpuBackend>(input);
}

std::unique_ptr<ViewBackend> open_checked_backend(BackendInput const& input,
                                                  DeviceChoice const& device, Warn const& warn) {
  auto opened =
      open_by_opengl(device, warn, [&](GlModule const& gl) { return gl.open(input, device); });
  auto cpu = std::make_unique<CpuBackend>(input);
  if (!opened) return cpu;
  auto checked = std::make_unique<CheckedBackend>(std::move(opened), std::move(cpu), input, warn);
  if (input.transmission.screens().entries().size() < 2) return checked;
  return std::make_unique<SheetPairsOnCpu>(std::move(checked), std::make_unique<CpuBackend>(input),
                                           input.transmission);
}

std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& device) {
  // Answers came first: what the device lacks has been told.
  auto raster = open_by_opengl(
      device, {}, [&](GlModule const& gl) { return gl.open_for_pictures(scene, device); });
  return raster ? std::move(raster) : std::make_unique<CpuPictureRaster>(scene);
}

}  // namespace gpu_shading
