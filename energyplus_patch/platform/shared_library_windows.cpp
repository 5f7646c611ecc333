#include <fmt/format.h>
#include <windows.h>

#include <system_error>

#include "gpu_shading/error.h"
#include "platform/shared_library.h"

namespace gpu_shading::energyplus {

SharedLibrary::SharedLibrary(std::filesystem::path const& path)
    : handle_(LoadLibraryExW(path.c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH)) {
  if (handle_ != nullptr) return;
  std::error_code const why(static_cast<int>(GetLastError()), std::system_category());
  throw Error(fmt::format("{}: cannot be loaded ({})", path.string(), why.message()));
}

void* SharedLibrary::address_of(char const* name) const {
  auto const found = GetProcAddress(static_cast<HMODULE>(handle_), name);
  if (found == nullptr) throw Error(fmt::format("EnergyPlus's library has no function {}", name));
  return reinterpret_cast<void*>(found);
}

}  // namespace gpu_shading::energyplus
