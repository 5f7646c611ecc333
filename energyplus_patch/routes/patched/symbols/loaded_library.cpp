#include "routes/patched/symbols/loaded_library.h"

#include <fmt/format.h>
#include <link.h>

#include <cstdint>
#include <fstream>
#include <sstream>

#include "gpu_shading/error.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {
namespace {

// Empty if there is none.
std::filesystem::path mapped_file(std::uintptr_t address) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream words(line);
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    std::string rest;
    char dash = 0;
    words >> std::hex >> begin >> dash >> end;
    if (address < begin || address >= end) continue;
    for (int i = 0; i < 4; ++i) words >> rest;  // permissions, offset, device, inode
    std::getline(words >> std::ws, rest);
    return rest;
  }
  return {};
}

// The loader may know a library by a name relative to what was the current folder then.
std::filesystem::path file_of(dl_phdr_info const& library) {
  std::filesystem::path const name = library.dlpi_name;
  return name.is_relative() ? mapped_file(library.dlpi_addr)
                            : std::filesystem::weakly_canonical(name);
}

}  // namespace

Loaded find_loaded(char const* wanted) {
  struct Search {
    std::filesystem::path wanted;
    Loaded found;
  } search;
  if (wanted != nullptr) search.wanted = official_behind(wanted);
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* context) {
        auto& s = *static_cast<Search*>(context);
        if (info->dlpi_name == nullptr || *info->dlpi_name == '\0') return 0;
        auto const path = file_of(*info);
        bool const match = s.wanted.empty()
                               ? path.filename().string().starts_with("libenergyplusapi") &&
                                     official_behind(path) == path
                               : path == s.wanted;
        if (!match) return 0;
        // NOLINTNEXTLINE(performance-no-int-to-ptr)
        s.found = {path, reinterpret_cast<std::byte*>(info->dlpi_addr)};
        return 1;
      },
      &search);
  if (search.found.path.empty()) {
    throw Error(
        fmt::format("{}: EnergyPlus's library must be loaded before GPU shading is installed",
                    wanted == nullptr ? "libenergyplusapi" : wanted));
  }
  return search.found;
}

}  // namespace gpu_shading::energyplus
