#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/input/shading_input.h"
#include "model/site/surroundings.h"

namespace gpu_shading::energyplus {

// Map data usually contains the modelled building, which would then shade itself. Returns one line
// for each neighbouring building that contains a wall, roof or floor of the model, but at most
// `most` lines.
std::vector<std::string> warn_of_own_buildings(std::vector<ContextBuilding> const& buildings,
                                               Scene const& scene, ShadingInput const& input,
                                               std::size_t most = 3);

}  // namespace gpu_shading::energyplus
