#pragma once

#include "backends/cpu/crowd_raster.h"
#include "gpu_shading/scene.h"
#include "rays/ray_shapes.h"
#include "scene/casters.h"
#include "view/pixel_mask.h"
#include "view/view.h"

namespace gpu_shading {

// Looks for a crowd from each sample, which takes less time than CrowdRaster where the casters
// outnumber the samples.
class CrowdRays {
 public:
  // Both must outlive it.
  CrowdRays(Scene const& scene, Casters const& casters);

  // As CrowdRaster does.
  void darken(PixelMask& mask, View const& pixels, CrowdQuestion const& question) const;

 private:
  Scene const& scene_;
  Casters const& casters_;
  RayShapes shapes_;  // as surfaces, positions in the casters' tree
};

}  // namespace gpu_shading
