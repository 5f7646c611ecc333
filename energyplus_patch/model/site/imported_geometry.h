#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "files/asset_folder.h"
#include "model/idf/input_object.h"
#include "model/site/site_origin.h"
#include "model/site/surroundings.h"

namespace gpu_shading::energyplus {

// Whether a GPUShading:Geometry is placed by latitude and longitude.
bool needs_origin(std::vector<InputObject> const& objects);

// Reads every GPUShading:Geometry: a caster for each triangle, facing the side from which its
// texture is not mirrored. `origin`: for those placed by latitude and longitude. Throws Error.
void read_geometries(std::vector<InputObject> const& objects, AssetFolder const& folder,
                     std::optional<SiteOrigin> const& origin, Surroundings& surroundings);

}  // namespace gpu_shading::energyplus
