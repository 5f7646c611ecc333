#pragma once

#include <string>
#include <vector>

#include "model/idf/field_changes.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/idf/new_object.h"
#include "model/input/shading_input.h"
#include "model/reflected_light.h"

namespace gpu_shading::energyplus {

// Reflected light, and what passes it to EnergyPlus: a ground of its own for each receiver. What is
// still to be added are the receivers' schedules.
struct ReflectedLightInput {
  ReflectedLight light;
  std::vector<FieldChange> changes;
  std::vector<NewObject> added;
  std::vector<std::string> remarks;  // receivers that keep EnergyPlus's own light, and why
};

// The receivers are all exterior surfaces that the sun can reach, with their windows and doors,
// except where EnergyPlus's light from the ground cannot be replaced. `more`: objects that are
// added to the model. `find_mentions`: to give new objects names that are in no field. Never throws
// Error: what cannot be interpreted is EnergyPlus's to report.
ReflectedLightInput read_reflected_light(std::vector<InputObject> const& objects,
                                         std::vector<InputObject> const& more,
                                         ShadingInput const& input,
                                         MentionFinder const& find_mentions);

// What reflects, for no receivers. Never throws Error.
ReflectedLight read_reflectors(std::vector<InputObject> const& objects, ShadingInput const& input);

// The receivers' schedules, to be set while EnergyPlus runs.
std::vector<NewObject> constant_schedules(ReflectedLight const& light);

}  // namespace gpu_shading::energyplus
