#pragma once

#include <filesystem>
#include <vector>

#include "program/model_run.h"
#include "session/view_list.h"

namespace gpu_shading::energyplus {

// Draws a model's receivers as the sun sees them, `size` pixels on the longer side, into a folder,
// which is made where it is missing: all pictures, or none. The surfaces come from EnergyPlus
// itself, run as far as it hands them over. Throws Error.
void draw(ModelRun const& run, std::vector<View> const& views, int size,
          std::filesystem::path const& folder);

}  // namespace gpu_shading::energyplus
