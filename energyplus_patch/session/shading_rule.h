#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/shading_input.h"

namespace gpu_shading::energyplus {

// Which casters EnergyPlus's PolygonClipping leaves out, from the model: Disable Self-Shading Within
// and From Shading Zone Groups, and MinimalShadowing. `names`: of every surface, by id; a reveal is
// named "WINDOW reveal N". Null where everything casts on everything.
ShadingRule make_shading_rule(ShadingInput const& input, std::vector<std::string> const& names);

}  // namespace gpu_shading::energyplus
