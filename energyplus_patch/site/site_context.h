#pragma once

#include <filesystem>
#include <vector>

#include "input/input_object.h"
#include "site/site_origin.h"
#include "site/surroundings.h"

namespace gpu_shading::energyplus {

// Reads every GPUShading:SiteContext, terrain first, on which the buildings of its own object
// stand. Where the origin is to be at the terrain's elevation it is found here. Throws Error.
void read_site_contexts(std::vector<InputObject> const& objects,
                        std::filesystem::path const& folder, SiteOrigin& origin,
                        Surroundings& surroundings);

}  // namespace gpu_shading::energyplus
