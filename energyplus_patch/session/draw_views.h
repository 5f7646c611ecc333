#pragma once

#include <filesystem>
#include <vector>

#include "gpu_shading/renderer.h"
#include "session/view_list.h"

namespace gpu_shading::energyplus {

// What draws: the model's receivers, the light that schedules let pass, and how large.
struct Drawing {
  Renderer& renderer;
  std::size_t receivers;  // surfaces before this one can be named
  std::vector<double> const& factors;
  int size;  // pixels on the longer side
};

// Into a folder. Throws Error where a receiver is not there or a picture cannot be written.
void draw_views(std::vector<View> const& views, std::filesystem::path const& folder,
                Drawing const& drawing);

}  // namespace gpu_shading::energyplus
