#include "files/sibling_file.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <system_error>

#include "gpu_shading/error.h"
#include "platform/process.h"

namespace gpu_shading::energyplus {

namespace {

// Empty if it is not known.
std::filesystem::path folder_of_this_code() noexcept try {
  Dl_info info{};
  link_map* map = nullptr;
  dladdr1(reinterpret_cast<void const*>(&folder_of_this_code), &info,
          reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP);
  // The program itself has no name there, and the name by which it was called may not lead
  // anywhere.
  if (map == nullptr || map->l_name == nullptr || *map->l_name == '\0') return own_folder();
  return std::filesystem::absolute(map->l_name).parent_path();
} catch (...) {
  return {};
}

// As this code is loaded: a library may be named relative to the folder that is current then.
std::filesystem::path const code_folder = folder_of_this_code();

}  // namespace

std::filesystem::path sibling_file(char const* name) {
  if (code_folder.empty()) throw Error(fmt::format("{}: its folder is not known", name));
  return code_folder / name;
}

std::string formats_package(std::filesystem::path const& file) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return {};
  return " (install the Debian package energyplus-gpu-shading-formats and run patch_energyplus "
         "again)";
}

}  // namespace gpu_shading::energyplus
