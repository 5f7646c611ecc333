#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/geometry_rules.h"
#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// Shading:Site:Detailed, Shading:Building:Detailed or Shading:Zone:Detailed.
bool is_detailed_shading(InputObject const& object);

// The outline of a detailed shading surface; nothing if one of its fields cannot be interpreted.
std::optional<Outline> outline_of(InputObject const& object, ShadingInput const& input,
                                  GeometryRules const& rules);

// Why outline_of() differs from EnergyPlus in this model (GeometryTransform, Compliance:Building),
// or "".
std::string reason_against_outlines(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
