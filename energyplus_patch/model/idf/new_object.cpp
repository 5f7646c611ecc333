#include "model/idf/new_object.h"

#include <fmt/format.h>

#include "model/idf/model_file.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// The type as the model spells it.
std::string key_of(nlohmann::json const& model, std::string_view type) {
  for (auto const& [key, instances] : model.items()) {
    if (same_name(key, type)) return key;
  }
  return std::string(type);
}

nlohmann::json epjson_fields(std::vector<NewField> const& fields) {
  auto object = nlohmann::json::object();
  for (auto const& field : fields) {
    if (!text_of(field.value).empty()) object[std::string(field.name)] = field.value;
  }
  return object;
}

}  // namespace

std::vector<std::string> idf_fields(NewObject const& object) {
  std::vector<std::string> texts;
  for (auto const& field : object.fields) texts.push_back(text_of(field.value));
  for (auto const& item : object.items) {
    for (auto const& field : item) texts.push_back(text_of(field.value));
  }
  return texts;
}

void add_object(nlohmann::json& model, NewObject const& object) {
  auto fields = epjson_fields(object.fields);
  for (auto const& item : object.items) {
    fields[std::string(object.array)].push_back(epjson_fields(item));
  }
  auto& instances = model[key_of(model, object.type)];
  auto name = fmt::format("{} {}", object.type, instances.size() + 1);
  if (auto const own = fields.find("name"); own != fields.end()) {
    name = text_of(*own);
    fields.erase(own);
  }
  instances[name] = std::move(fields);
}

}  // namespace gpu_shading::energyplus
