#pragma once

#include <filesystem>
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

// All objects of a type in epJSON. As in EnergyPlus, types of values and case of words must be
// exactly those of the schema. Throws Error as above, and for JSON of another shape.
std::vector<InputObject> read_extensions(std::string_view type, nlohmann::json const& instances);

// Throws Error if two extension objects of a type have the same name, or if there are several of a
// unique type.
void check_unique(std::vector<InputObject> const& objects);

// The extension objects of a side file, IDF or epJSON, with or without a Version. Throws Error,
// naming the file, for other objects, an object without its semicolon, or text that is not UTF-8. A
// byte order mark and line ends of every kind are accepted.
std::vector<InputObject> read_side_file(std::filesystem::path const& path);

}  // namespace gpu_shading::energyplus
