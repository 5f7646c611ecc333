#include "assets/plugin.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <filesystem>

#include "base/process.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

std::filesystem::path folder_of_this_code() {
  Dl_info info{};
  link_map* map = nullptr;
  dladdr1(reinterpret_cast<void const*>(&plugin_function), &info, reinterpret_cast<void**>(&map),
          RTLD_DL_LINKMAP);
  // The program itself has no name there, and the name by which it was called may not lead
  // anywhere.
  if (map == nullptr || map->l_name == nullptr || *map->l_name == '\0') return own_folder();
  return std::filesystem::path(map->l_name).parent_path();
}

}  // namespace

void* plugin_function(char const* library, char const* what, char const* name) {
  auto const path = folder_of_this_code() / library;
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw Error(fmt::format("{} need {}: {}", what, library, dlerror()));
  void* const function = dlsym(handle, name);
  if (function == nullptr) throw Error(fmt::format("{}: {}", path.string(), dlerror()));
  return function;
}

}  // namespace gpu_shading::energyplus
