#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/options/options.h"

namespace gpu_shading::energyplus {

inline constexpr int not_run = -1;

// A whole run of an unmodified EnergyPlus library, with sunlit fractions rendered before it.
// `arguments`: EnergyPlus's own. Returns its exit status. Throws Error.
int run_scheduled(std::filesystem::path const& library, Choices const& choices,
                  std::vector<std::string> arguments);

}  // namespace gpu_shading::energyplus
