#pragma once

#include <string>
#include <vector>

#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// Before EnergyPlus asks for a sunlit area, it looks for casters in front of the receiver
// (CHKGSS), and takes the planes of both from the corner at their second vertex; the mirrored copy
// of a shading surface has there the last vertex but one. Where that corner is reflex, the plane
// faces the wrong way: shadows would be missing.
//
// Names of detailed surfaces outdoors with such a corner, without those that are left out of
// EnergyPlus's input.
std::vector<std::string> find_reflex_corners(std::vector<InputObject> const& objects,
                                             ShadingInput const& input, Names const& left_out);

}  // namespace gpu_shading::energyplus
