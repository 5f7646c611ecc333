#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "gpu_shading/screen_placement.h"
#include "model/model_reader.h"

namespace gpu_shading::energyplus {

// How a surface takes part in the shading calculation.
struct ListedSurface {
  std::string name;
  std::string kind;
  double area = 0.0;                                // m2
  bool receives = false;                            // whether its own sunlit fraction is rendered
  std::optional<std::string> casts = std::nullopt;  // its optics; empty: it casts no shadows
  std::optional<TileAxes> tile = std::nullopt;      // of its screen
};

struct Listing {
  std::vector<std::string> remarks;  // what lean input did, and which surroundings were read
  std::vector<ListedSurface> surfaces;
  std::string rule;  // lines that say which zones do not shade which
};

// `wanted`: by EnergyPlus's surfaces. The surfaces after these are not in its input: first those
// left out by lean input, then the surroundings, with one row for a mesh and none for neighbouring
// buildings and terrain.
Listing list_surfaces(Scene const& scene, Model const& model, std::vector<bool> const& wanted);

// A table, with the position of its tile below a screen.
std::string to_text(Listing const& listing);
// The same as one JSON document (docs/reference/files.md).
std::string to_json_text(Listing const& listing);

// The outlines of the same surfaces, one vertex per line, as comma-separated values.
std::string list_vertices(Scene const& scene, Model const& model);

}  // namespace gpu_shading::energyplus
