#include "assets/beside.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

#include "base/process.h"

namespace gpu_shading::energyplus {

std::filesystem::path beside_this_code(char const* name) {
  Dl_info info{};
  link_map* map = nullptr;
  dladdr1(reinterpret_cast<void const*>(&beside_this_code), &info, reinterpret_cast<void**>(&map),
          RTLD_DL_LINKMAP);
  // The program itself has no name there, and the name by which it was called may not lead
  // anywhere.
  if (map == nullptr || map->l_name == nullptr || *map->l_name == '\0') return own_folder() / name;
  return std::filesystem::path(map->l_name).parent_path() / name;
}

std::string formats_package(std::filesystem::path const& file) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return {};
  return " (install the Debian package energyplus-gpu-shading-formats and run patch_energyplus "
         "again)";
}

}  // namespace gpu_shading::energyplus
