#include "files/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "files/sibling_file.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
void* plugin_function(char const* library, char const* what, char const* name) {
  auto const path = sibling_file(library);
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw Error(fmt::format("{} need {}: {}{}", what, library, dlerror(), formats_package(path)));
  }
  void* const function = dlsym(handle, name);
  if (function == nullptr) throw Error(fmt::format("{}: {}", path.string(), dlerror()));
  return function;
}

}  // namespace gpu_shading::energyplus
