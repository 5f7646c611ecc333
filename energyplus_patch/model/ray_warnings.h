#pragma once

#include <optional>
#include <string>
#include <vector>

#include "idf/input_object.h"
#include "input/shading_input.h"

namespace gpu_shading::energyplus {

// What EnergyPlus's own rays make of shades that only this module knows: a warning for each pair of
// a user of rays (daylighting, solar reflections, complex fenestration) and a type of shade that
// the model has, naming the objects. Rays count TransparentShades and PerforatedScreens as opaque,
// but for their Transmittance Schedules, and do not meet Geometry and SiteContext.
// `daylighting_opaque`: if the rays of daylighting are answered, the surfaces of such shades that
// are in EnergyPlus's input all the same; one warning names them.
std::vector<std::string> warn_of_rays(
    std::vector<InputObject> const& objects, ShadingInput const& input,
    std::optional<std::vector<std::string>> const& daylighting_opaque = std::nullopt);

}  // namespace gpu_shading::energyplus
