#pragma once

#include <filesystem>
#include <vector>

#include "model/idf/input_object.h"
#include "model/site/site_origin.h"
#include "model/site/surroundings.h"

namespace gpu_shading::energyplus {

// Reads every GPUShading:SiteContext, terrain first, because buildings stand on the terrain of the
// same object. If the origin is to be at the terrain's elevation, that is determined here. Throws
// Error.
void read_site_contexts(std::vector<InputObject> const& objects,
                        std::filesystem::path const& folder, SiteOrigin& origin,
                        Surroundings& surroundings);

}  // namespace gpu_shading::energyplus
