#pragma once

#include <filesystem>
#include <string>
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

// What goes together into one file.
struct CaptionedView {
  View view;  // under any name
  std::string caption;
};

// The same of pictures below their captions, in rows or, where the file's name ends in .gif, one
// after another; with a scale of sunlit fractions beside whole scenes.
void draw_together(ModelRun const& run, std::vector<CaptionedView> const& views,
                   std::filesystem::path const& file, int size);

}  // namespace gpu_shading::energyplus
