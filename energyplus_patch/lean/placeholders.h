#pragma once

#include <string>
#include <vector>

#include "lean/mentions.h"

namespace gpu_shading::energyplus {

// Shading surfaces that EnergyPlus reads in place of those that were left out.
struct Placeholder {
  std::string name;
  std::string schedule;  // of transmittance, or ""
  bool north = false;    // of the model, else south
};

// EnergyPlus asks for the sunlit area of a receiver where some caster has a vertex in front of its
// plane and reaches higher than its lowest vertex. The eight corners of two parallel walls, far
// away on either side of the model and reaching as far down as up, are in front of every plane
// there is. EnergyPlus also looks at transmittance schedules, to decide how often it needs the
// sky's shading: each of `schedules` gets a placeholder of its own. Names are unlike any of
// `taken`.
std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken);

// Fields of the Shading:Site:Detailed object: name, schedule, number of vertices, coordinates.
std::vector<std::string> placeholder_fields(Placeholder const& placeholder);
nlohmann::json placeholder_json(Placeholder const& placeholder);

inline constexpr char const* placeholder_type = "Shading:Site:Detailed";

}  // namespace gpu_shading::energyplus
