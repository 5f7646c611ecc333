#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// One object of a model, from either file format, with fields by their names in the epJSON schema.
// Only the types and fields that affect shading are known here; see known_fields.
struct InputObject {
  std::string type;  // as known_types() or the dictionary spells it
  std::string name;  // "" for types without one
  std::map<std::string, std::string, std::less<>> fields;  // numbers as text
  // The extensible part of ZoneList, ShadowCalculation, ..., one field after another: for vertices
  // x, y and z, and so on.
  std::vector<std::string> list;
  std::string file = {};  // of the object; "" if unknown

  // The field's text, "" if it is blank or absent.
  std::string const& operator[](std::string_view field) const;

  // "TYPE NAME", or "TYPE" for types without a name.
  std::string title() const;
  // "FILE: TYPE NAME", as errors begin.
  std::string where() const;
};

// EnergyPlus's own types that are read, with their fields in the IDF's order ("name" first where
// there is one).
struct ObjectType {
  std::string_view type;
  std::vector<std::string_view> fields;
  std::string_view list = {};  // epJSON name of the extensible array, if it is read
  std::vector<std::string_view> list_fields = {};  // of each of its items

  bool has(std::string_view field) const;
};
std::vector<ObjectType> const& known_types();
ObjectType const* find_type(std::string_view type);

// The types of all our objects begin with this.
inline constexpr std::string_view extension_prefix = "GPUShading:";
bool is_extension(std::string_view type);

}  // namespace gpu_shading::energyplus
