#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/idf/input_object.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// Where rays are answered, the surfaces of shades that are in EnergyPlus's input all the same. One
// warning names them.
struct OpaqueToRays {
  std::optional<std::vector<std::string>> daylighting = std::nullopt;  // unless answered
  std::optional<std::vector<std::string>> reflections = std::nullopt;
};

// What EnergyPlus's own rays make of shades that only this module knows: a warning for each pair of
// a user of rays (daylighting, solar reflections, complex fenestration) and a type of shade that
// the model has, naming the objects. Rays count TransparentShades and PerforatedScreens as opaque,
// but for their Transmittance Schedules where they are not of solar reflections, and do not meet
// Geometry and SiteContext.
std::vector<std::string> warn_of_rays(std::vector<InputObject> const& objects,
                                      ShadingInput const& input, OpaqueToRays const& opaque = {});

}  // namespace gpu_shading::energyplus
