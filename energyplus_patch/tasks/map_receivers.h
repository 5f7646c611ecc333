#pragma once

#include <string>

#include "reports/map_file.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Traces the maps of a completed assembly's receivers and writes them to the request's file.
// Returns a line for the user. Throws Error, also if the receivers have too many cells.
std::string map_receivers(MapRequest const& request, SceneAssembly& scene);

}  // namespace gpu_shading::energyplus
