#include "host/loaded_library.h"

#include <fmt/format.h>
#include <link.h>

#include "gpu_shading/error.h"
#include "runs/installation.h"

namespace gpu_shading::energyplus {

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
        auto const path = std::filesystem::weakly_canonical(info->dlpi_name);
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
