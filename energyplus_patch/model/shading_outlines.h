#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gpu_shading/scene.h"
#include "model/geometry_rules.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"

namespace gpu_shading::energyplus {

// Shading:Site:Detailed, Shading:Building:Detailed or Shading:Zone:Detailed.
bool is_detailed_shading(InputObject const& object);

// The same, or a wall, roof, floor, window or door with vertices.
bool is_detailed_surface(InputObject const& object);

// The outline of a detailed surface; nothing if one of its fields cannot be interpreted.
std::optional<Outline> outline_of(InputObject const& object, ShadingInput const& input,
                                  GeometryRules const& rules);

// Why outline_of() differs from EnergyPlus in this model (GeometryTransform, Compliance:Building),
// or "".
std::string reason_against_outlines(std::vector<InputObject> const& objects);

// Shading surfaces in EnergyPlus's input from which EnergyPlus deletes vertices within 1 cm of each
// other: a slat of 4 mm would become a triangle.
struct SimplifiedSurfaces {
  std::map<std::string, Ring> outlines;  // as the model gives them, by EnergyPlus's names
  std::string warning;                   // which surfaces, in EnergyPlus's words; "" if none
};

// Detailed shading surfaces, without those that are left out of EnergyPlus's input. Never throws:
// what cannot be interpreted is EnergyPlus's to report.
SimplifiedSurfaces find_simplified_surfaces(std::vector<InputObject> const& objects,
                                            ShadingInput const& input, Names const& left_out);

}  // namespace gpu_shading::energyplus
