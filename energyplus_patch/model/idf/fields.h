#pragma once

#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/extensions/field.h"
#include "model/idf/input_object.h"
#include "platform/naming.h"

// Reading an object's fields. Every function throws Error: field, value, what was expected; the
// object is for the caller to name, as for_each_of() does.
namespace gpu_shading::energyplus {

// Calls `use` for every object of a type. Errors name the object.
template <typename Use>
void for_each_of(std::vector<InputObject> const& objects, std::string_view type, Use const& use) {
  for (auto const& object : objects) {
    if (object.type == type) naming(object.where(), [&] { use(object); });
  }
}

// The field's value, or its default where it is blank.
template <typename Value>
Value read(InputObject const& object, Field<Value> const& field) {
  return parse(field, object[field.key], field.title);
}

// The items that are not blank.
std::vector<std::string> read(InputObject const& object,
                              Field<std::vector<std::string>> const& field);

// The value of a field that may be blank elsewhere, but not here.
[[noreturn]] void refuse_blank(FieldInfo const& field);
template <typename Value>
Value needed(InputObject const& object, Field<std::optional<Value>> const& field) {
  auto const value = read(object, field);
  if (!value) refuse_blank(field);
  return *value;
}

// Degrees that are given together or not at all.
struct Coordinates {
  double latitude;
  double longitude;
};
std::optional<Coordinates> read_coordinates(InputObject const& object,
                                            Field<std::optional<double>> const& latitude,
                                            Field<std::optional<double>> const& longitude);

// `why`, as in "with Hole Shape Texture".
using Fields = std::initializer_list<std::reference_wrapper<FieldInfo const>>;
void expect_blank(InputObject const& object, Fields const& fields, std::string_view why);

}  // namespace gpu_shading::energyplus
