#pragma once

#include <string>
#include <vector>

#include "lean/mentions.h"

namespace gpu_shading::energyplus {

// Shading surfaces that EnergyPlus reads in place of casters that it does not know.
struct Placeholder {
  std::string name;
  std::string schedule;  // of transmittance, or ""
  int quarter = 0;       // 0 .. 3: north-east of the model, and on counter-clockwise
};

// EnergyPlus asks for the sunlit area of a receiver where some caster has a vertex in front of its
// plane and reaches higher than its lowest vertex. Of four poles, far away in the four quarters and
// reaching as far down as up, some end is in front of every plane there is. They are so narrow that
// the rays of daylighting and of solar reflections do not meet them. EnergyPlus also looks at
// transmittance schedules, to decide how often it needs the sky's shading: each of `schedules` gets
// a placeholder of its own. Names are unlike any of `taken`.
std::vector<Placeholder> make_placeholders(std::vector<std::string> const& schedules,
                                           Names const& taken);

// Fields of the Shading:Site:Detailed object: name, schedule, number of vertices, coordinates.
std::vector<std::string> placeholder_fields(Placeholder const& placeholder);
nlohmann::json placeholder_json(Placeholder const& placeholder);

inline constexpr char const* placeholder_type = "Shading:Site:Detailed";

}  // namespace gpu_shading::energyplus
