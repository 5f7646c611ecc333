#pragma once

#include <string>
#include <vector>

#include "gpu_shading/local_axes.h"
#include "model/idf/input_object.h"

namespace gpu_shading::energyplus {

// The geographic position of the origin of the model's world axes. A model has only one: that of
// the first GPUShading:SiteContext that gives one, or Site:Location of the model (not of the
// weather file).
struct SiteOrigin {
  GeographicPoint place;
  std::string source;  // "Site:Location" or the object that gave it
  // Whether the terrain there determines the elevation.
  bool at_terrain = false;
};

// Throws Error, naming object, field and value, if two objects do not agree, a position is invalid,
// or there is none.
SiteOrigin find_site_origin(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
