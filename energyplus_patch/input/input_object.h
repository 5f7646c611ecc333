#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace gpu_shading::energyplus {

// EnergyPlus compares names without regard to case; so do these.
std::string upper(std::string_view text);
bool same_name(std::string_view a, std::string_view b);

// One object of a model, whichever file format it came in: fields by the names that the epJSON
// schema gives them. Only the types and fields that shading depends on are known here; see
// known_fields.
struct InputObject {
  std::string type;                           // as known_types() spells it
  std::string name;                           // "" for types without one
  std::map<std::string, std::string> fields;  // numbers as text
  // The extensible part of ZoneList, ShadowCalculation, ...; of vertices x, y and z in turn.
  std::vector<std::string> list;

  // The field's text, "" where it is blank or absent.
  std::string const& operator[](std::string const& field) const;

  // "TYPE NAME", as messages begin; "TYPE" where it has no name.
  std::string title() const;
};

// The types that are read, with their fields in the IDF's order ("name" first where there is one).
struct ObjectType {
  std::string_view type;
  std::vector<std::string_view> fields;
  std::string_view list = {};        // epJSON name of the extensible array, if it is read
  std::string_view list_field = {};  // the field of its items; "" for vertices, which have three
};
std::vector<ObjectType> const& known_types();
ObjectType const* find_type(std::string_view type);

// Every object of ours begins with this.
inline constexpr std::string_view extension_prefix = "GPUShading:";
bool is_extension(std::string_view type);

}  // namespace gpu_shading::energyplus
