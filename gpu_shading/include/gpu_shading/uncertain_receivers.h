#pragma once

#include <span>
#include <vector>

#include "gpu_shading/scene.h"

namespace gpu_shading {

// Receivers whose sunlit fractions may be further off than RendererOptions::error, where a view of
// them is sampled.
struct UncertainReceivers {
  // Behind two layers of repeated blades, such as slats, that are parallel but at other distances:
  // the pattern of one beats with that of the other.
  std::vector<SurfaceId> behind_layers;
  // Filling less than a fifth of their bounding rectangle, behind a perforated sheet.
  std::vector<SurfaceId> narrow;
};

// Uses geometry only: in time proportional to the number of surfaces, and to that of receivers
// times that of layers and sheets. Throws std::out_of_range for a receiver that is not in the
// scene.
UncertainReceivers find_uncertain_receivers(Scene const& scene,
                                            std::span<SurfaceId const> receivers);

}  // namespace gpu_shading
