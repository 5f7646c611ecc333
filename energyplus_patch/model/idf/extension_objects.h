#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "model/idf/idf_text.h"
#include "model/idf/input_object.h"

// Extension objects (GPUShading:...), every field checked against the dictionary. Errors name
// object, field, value and what was expected.
namespace gpu_shading::energyplus {

// Throws Error: no such type, too many fields, a field that the dictionary does not allow.
InputObject read_extension(IdfObject const& object);

// All objects of a type in epJSON. Types of values and case of words are as EnergyPlus wants them
// there: those of the schema, to the letter. Throws Error as above, and on any other shape.
std::vector<InputObject> read_extensions(std::string_view type, nlohmann::json const& instances);

// Throws Error if two extension objects of a type have one name, or if there are several of a type
// of which there is one at most.
void check_unique(std::vector<InputObject> const& objects);

}  // namespace gpu_shading::energyplus
