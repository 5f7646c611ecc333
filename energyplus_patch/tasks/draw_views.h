#pragma once

#include <filesystem>
#include <vector>

#include "gpu_shading/renderer.h"
#include "tasks/view_list.h"

namespace gpu_shading::energyplus {

// What draws.
struct Drawing {
  Renderer& renderer;
  std::vector<SurfaceId> shown;        // the model's surfaces, which the user can name
  std::vector<bool> receives;          // by surface: whether it is coloured by its sunlit fraction
  std::vector<double> const& factors;  // what schedules let pass
  int size;                            // pixels on the longer side
};

// Into a folder: all of them, or none. Throws Error if a receiver does not exist or a picture
// cannot be written.
void draw_views(std::vector<SunView> const& views, std::filesystem::path const& folder,
                Drawing const& drawing);

}  // namespace gpu_shading::energyplus
