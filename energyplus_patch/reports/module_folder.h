#pragma once

#include <filesystem>
#include <optional>

#include "reports/page/run_page.h"

namespace gpu_shading::energyplus {

// A folder that `gpu_shading modules` wrote. Nothing if it has no modules. Throws Error, naming the
// file, if one is not as `gpu_shading modules` writes it, or is larger than 64 MiB.
std::optional<PageModules> read_module_folder(std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
