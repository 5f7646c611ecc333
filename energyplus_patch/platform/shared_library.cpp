#include "platform/shared_library.h"

#include <dlfcn.h>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

SharedLibrary::SharedLibrary(std::filesystem::path const& path)
    : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) throw Error(dlerror());
}

void* SharedLibrary::address_of(char const* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) throw Error(dlerror());
  return found;
}

}  // namespace gpu_shading::energyplus
