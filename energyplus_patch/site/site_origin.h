#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/local_axes.h"
#include "input/input_object.h"

namespace gpu_shading::energyplus {

// Where on earth the model's world axes have their origin. A model has one such place: that of the
// first GPUShading:SiteContext that gives one, else Site:Location, of the model and not of the
// weather file.
struct SiteOrigin {
  GeographicPoint place;
  std::string source;  // "Site:Location" or the object that gave it
  // The elevation is asked to be the terrain's there.
  bool at_terrain = false;
};

// Throws Error, naming object, field and value: two objects that do not agree, a place that is
// none, no place at all.
SiteOrigin find_site_origin(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
