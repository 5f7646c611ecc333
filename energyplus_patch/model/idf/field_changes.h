#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "model/idf/new_object.h"

namespace gpu_shading::energyplus {

// The position of a field in each kind of file.
struct FieldPosition {
  std::size_t index;      // index in the IDF, from 0
  std::string_view name;  // in epJSON
};

// The position of a known field of a known type (known_types).
FieldPosition position_of(std::string_view type, std::string_view field);

// A field of a model that is replaced.
struct FieldChange {
  std::string_view type;
  // The object's name; "" for all objects of the type, one of which is added if there is none.
  std::string object;
  FieldPosition field;
  nlohmann::json value;
};

// Applies changes to a model's objects, each in constant time.
class FieldChanges {
 public:
  explicit FieldChanges(std::vector<FieldChange> const& changes);

  // To an object of an IDF. Returns whether there was a change for it.
  bool apply(std::string_view type, std::vector<std::string>& fields);
  // To all of an epJSON. Throws Error where a changed type has another shape than objects.
  void apply(nlohmann::json& model);

  // The objects to add, since there is none of their type.
  std::vector<NewObject> missing() const;

 private:
  struct ChangesOfType {
    std::vector<FieldChange const*> all;
    std::unordered_map<std::string, std::vector<FieldChange const*>> by_name;  // upper case
    bool met = false;  // an object of this type

    template <typename Use>
    bool for_each(std::string_view name, Use const& use) const;
  };

  std::unordered_map<std::string, ChangesOfType> types_;  // upper case
};

// Applies them to an epJSON, and adds what is missing.
void apply_changes(nlohmann::json& model, std::vector<FieldChange> const& changes);

// The changes of ShadowCalculation. `frequency`: "" keeps the model's.
std::vector<FieldChange> shading_method(std::string_view method, std::string_view frequency = "");

}  // namespace gpu_shading::energyplus
