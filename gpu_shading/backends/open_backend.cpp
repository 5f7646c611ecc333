#include "backends/open_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "backends/checked/checked_backend.h"
#include "backends/cpu/cpu_backend.h"
#include "backends/modules.h"
#include "backends/sheet_pairs_on_cpu.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

DeviceModule const& module_of(DeviceId const& device) {
  auto const modules = device_modules();
  auto const found = std::ranges::find(modules, device.module, &NamedModule::name);
  if (found == modules.end()) {
    throw DeviceError(
        fmt::format("device {}: there is no module '{}'", device_name(device), device.module));
  }
  return found->get();
}

// Null if the module cannot be loaded here.
DeviceModule const* try_load(NamedModule const& module) {
  try {
    return &module.get();
  } catch (DeviceError const&) {
    return nullptr;
  }
}

// Opens the chosen device by open(module), or else that of the first module that opens one.
template <typename Open>
auto open_device(DeviceChoice const& choice, Warn const& warn, Open open) {
  if (choice.device) return open(module_of(*choice.device));
  decltype(open(module_of({}))) opened;
  for (NamedModule const& named : device_modules()) {
    DeviceModule const* const module = try_load(named);
    try {
      if (module != nullptr) opened = open(*module);
    } catch (DeviceError const& error) {
      if (warn) warn(fmt::format("the GPU cannot be used: {}", error.what()));
    }
    if (opened) break;
  }
  return opened;
}

}  // namespace

std::unique_ptr<ViewBackend> open_backend(BackendInput const& input, DeviceChoice const& choice,
                                          Warn const& warn) {
  return open_device(choice, warn,
                     [&](DeviceModule const& module) { return module.open(input, choice); });
}

std::unique_ptr<ViewBackend> open_checked_backend(BackendInput const& input,
                                                  DeviceChoice const& choice, Warn const& warn) {
  auto opened = open_backend(input, choice, warn);
  if (opened->device().id.is_cpu()) return opened;
  auto checked = std::make_unique<CheckedBackend>(std::move(opened),
                                                  std::make_unique<CpuBackend>(input), input, warn);
  if (input.transmission.screens().entries().size() < 2) return checked;
  return std::make_unique<SheetPairsOnCpu>(std::move(checked), std::make_unique<CpuBackend>(input),
                                           input.transmission);
}

std::unique_ptr<PictureRaster> open_picture_raster(PictureScene const& scene,
                                                   DeviceChoice const& choice) {
  // Answers came first: their user was told what the device lacks.
  return open_device(choice, {}, [&](DeviceModule const& module) {
    return module.open_for_pictures(scene, choice);
  });
}

}  // namespace gpu_shading
