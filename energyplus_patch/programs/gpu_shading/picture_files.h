#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "programs/gpu_shading/model_run.h"
#include "tasks/view_list.h"

namespace gpu_shading::energyplus {

// Draws a model as the sun sees it, `size` pixels on the longer side, into files of a folder in the
// formats of their extensions: all of them, or none. The folder is created if it is missing. The
// surfaces come from EnergyPlus itself, which runs until it has passed them. Throws Error.
void draw(ModelRun const& run, std::vector<SunView> const& views,
          std::filesystem::path const& folder, int size);

// Pictures to combine in one file.
struct CaptionedView {
  SunView view;  // under any name
  std::string caption;
};

// The same for pictures below their captions, arranged in rows or, if the file's name ends in .gif,
// as an animation; with a scale of sunlit fractions beside whole scenes.
void draw_together(ModelRun const& run, std::vector<CaptionedView> const& views,
                   std::filesystem::path const& file, int size);

}  // namespace gpu_shading::energyplus
