#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "input/shading_input.h"

namespace gpu_shading::energyplus {

// Whether a surface's name says that EnergyPlus has made it of a window's edge.
bool is_reveal(std::string const& name);

// A wall shades the windows in it through its own openings, and everything else as if it had none,
// as in EnergyPlus's PolygonClipping: set-back windows and their reveals then cast on nothing
// outside. Such a wall has a second surface in the scene, without openings, by this name.
std::string without_openings(std::string const& wall);

// Which casters EnergyPlus's PolygonClipping leaves out: walls with openings, their copies without,
// and reveals, where the other is meant; and, as the model asks, Disable Self-Shading Within and
// From Shading Zone Groups, and MinimalShadowing. `names`: of every surface, by id; a reveal is
// named "WINDOW reveal N".
ShadingRule make_shading_rule(ShadingInput const& input, std::vector<std::string> const& names);

// All that the rule depends on, in numbers that stand for names: where they are equal, so are the
// rules, whatever the surfaces are called.
std::vector<std::uint32_t> describe_shading_rule(ShadingInput const& input,
                                                 std::vector<std::string> const& names);

}  // namespace gpu_shading::energyplus
