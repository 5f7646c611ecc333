#pragma once

#include <span>
#include <string_view>

#include "backends/interface/device_module.h"

namespace gpu_shading {

struct NamedModule {
  std::string_view name;         // as in DeviceId
  DeviceModule const& (*get)();  // throws DeviceError if it cannot be loaded
  bool (*may_have_device)();     // without loading it; false: none can be found
};

// In the order in which a GPU is looked for, and the CPU, which always opens, last.
std::span<NamedModule const> device_modules();

}  // namespace gpu_shading
