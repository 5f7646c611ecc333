#pragma once

#include <filesystem>
#include <vector>

#include "program/model_run.h"
#include "session/view_list.h"

namespace gpu_shading::energyplus {

struct Picture {
  View view;  // under any name
  std::filesystem::path file;
};

// Draws a model as the sun sees it, `size` pixels on the longer side, into files of the formats
// that their names' endings tell: all of them, or none. Folders are made where they are missing.
// The surfaces come from EnergyPlus itself, run as far as it hands them over. Throws Error.
void draw(ModelRun const& run, std::vector<Picture> const& pictures, int size);

}  // namespace gpu_shading::energyplus
