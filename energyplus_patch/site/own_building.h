#pragma once

#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/shading_input.h"
#include "site/surroundings.h"

namespace gpu_shading::energyplus {

// Maps have the building that is modelled too, which then stands in its own sun. One line for each
// neighbouring building inside which a wall, roof or floor of the model lies, but for `most` of
// them no more.
std::vector<std::string> warn_of_own_buildings(std::vector<ContextBuilding> const& buildings,
                                               Scene const& scene, ShadingInput const& input,
                                               std::size_t most = 3);

}  // namespace gpu_shading::energyplus
