#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// A value, a string or a number, under its name in epJSON.
struct NewField {
  std::string_view name;
  nlohmann::json value;
};

// An object to add to a model.
struct NewObject {
  std::string_view type;
  std::vector<NewField> fields;  // in the IDF's order, all of them up to the last
  // The extensible part, in epJSON an array of this name.
  std::string_view array = {};
  std::vector<std::vector<NewField>> items = {};
};

// Its fields in an IDF.
std::vector<std::string> idf_fields(NewObject const& object);

// Adds it to an epJSON, without its blank fields.
void add_object(nlohmann::json& model, NewObject const& object);

}  // namespace gpu_shading::energyplus
