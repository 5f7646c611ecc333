#include "model/idf/field_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "gpu_shading/error.h"
#include "model/idf/input_object.h"
#include "model/idf/model_file.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

FieldPosition position_of(std::string_view type, std::string_view field) {
  auto const* known = find_type(type);
  if (known == nullptr) throw std::logic_error(fmt::format("{} is no known type", type));
  auto const found = std::ranges::find(known->fields, field);
  if (found == known->fields.end()) {
    throw std::logic_error(fmt::format("{} is no known field of {}", field, type));
  }
  return {static_cast<std::size_t>(found - known->fields.begin()), *found};
}

FieldChanges::FieldChanges(std::vector<FieldChange> const& changes) {
  for (auto const& change : changes) {
    auto& of_type = types_[upper(change.type)];
    auto& list = change.object.empty() ? of_type.all : of_type.by_name[upper(change.object)];
    list.push_back(&change);
  }
}

template <typename Use>
bool FieldChanges::ChangesOfType::for_each(std::string_view name, Use const& use) const {
  for (auto const* change : all) use(*change);
  auto const named = by_name.find(upper(name));
  if (named == by_name.end()) return !all.empty();
  for (auto const* change : named->second) use(*change);
  return true;
}

bool FieldChanges::apply(std::string_view type, std::vector<std::string>& fields) {
  auto const found = types_.find(upper(type));
  if (found == types_.end()) return false;
  found->second.met = true;
  auto const name = fields.empty() ? std::string() : fields.front();
  return found->second.for_each(name, [&](FieldChange const& change) {
    fields.resize(std::max(fields.size(), change.field.index + 1));
    fields[change.field.index] = text_of(change.value);
  });
}

void FieldChanges::apply(nlohmann::json& model) {
  for (auto const& [type, instances] : model.items()) {
    auto const found = types_.find(upper(type));
    if (found == types_.end()) continue;
    if (!instances.is_object()) throw Error(fmt::format("{}: expected an object of objects", type));
    for (auto const& [name, fields] : instances.items()) {
      require_object(fields, type, name);
      found->second.met = true;
      found->second.for_each(name, [&, &object = fields](FieldChange const& change) {
        object[std::string(change.field.name)] = change.value;
      });
    }
  }
}

std::vector<NewObject> FieldChanges::missing() const {
  std::vector<NewObject> objects;
  for (auto const& [upper_type, changes] : types_) {
    if (changes.met || changes.all.empty()) continue;
    NewObject object{changes.all.front()->type, {}};
    for (auto const* change : changes.all) {
      auto const index = change->field.index;
      if (object.fields.size() <= index) object.fields.resize(index + 1, {"", ""});
      object.fields[index] = {change->field.name, change->value};
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

void apply_changes(nlohmann::json& model, std::vector<FieldChange> const& changes) {
  FieldChanges applied(changes);
  applied.apply(model);
  for (auto const& object : applied.missing()) add_object(model, object);
}

std::vector<FieldChange> shading_method(std::string_view method, std::string_view frequency) {
  constexpr std::string_view type = "ShadowCalculation";
  std::vector<FieldChange> changes{
      {type, "", position_of(type, "shading_calculation_method"), method}};
  if (!frequency.empty()) {
    changes.push_back(
        {type, "", position_of(type, "shading_calculation_update_frequency_method"), frequency});
  }
  return changes;
}

}  // namespace gpu_shading::energyplus
