#pragma once

#include <filesystem>
#include <vector>

#include "gpu_shading/renderer.h"
#include "session/view_list.h"

namespace gpu_shading::energyplus {

// What draws.
struct Drawing {
  Renderer& renderer;
  DeviceChoice device;
  std::vector<SurfaceId> shown;        // the model's surfaces, which can be named
  std::vector<bool> receives;          // by surface, whether its sunlit fraction is a colour
  std::vector<double> const& factors;  // what schedules let pass
  int size;                            // pixels on the longer side
};

// Into a folder. Throws Error where a receiver is not there or a picture cannot be written.
void draw_views(std::vector<View> const& views, std::filesystem::path const& folder,
                Drawing const& drawing);

}  // namespace gpu_shading::energyplus
