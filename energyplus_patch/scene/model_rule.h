#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// The window that a reveal belongs to, or nothing. EnergyPlus hands over the sides of a set-back
// window's opening as surfaces that it names "WINDOW reveal 1", "WINDOW reveal 2", ...
std::optional<std::string> window_of_reveal(std::string const& surface);

// A wall that shades the windows in it through its openings, and its copy without openings, which
// shades everything else, as in EnergyPlus's PolygonClipping: set-back windows and their reveals
// then cast no shadows outside.
struct WallCopy {
  SurfaceId wall = 0;
  SurfaceId copy = 0;
};

// The casters that EnergyPlus's PolygonClipping leaves out: walls with openings and their copies
// where the other is meant; reveals for all but their window; and, as the model asks, Disable
// Self-Shading Within and From Shading Zone Groups, and MinimalShadowing.
struct ModelRule {
  ShadingRule rule;
  // What each of the rule's zones stands for: zones of the model that shade and are shaded alike.
  // None for the first, which is that of shading surfaces.
  std::vector<std::vector<std::string>> zones;
};
ModelRule make_shading_rule(ShadingInput const& input, Scene const& scene,
                            std::vector<WallCopy> const& copies);

// Lines that say which zones do not shade which; "" where all zones shade each other.
std::string describe(ModelRule const& rule);

}  // namespace gpu_shading::energyplus
