#include "input/model_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu_shading/error.h"
#include "input/idf_text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view shadow_calculation = "ShadowCalculation";
constexpr std::size_t method_field = 0;
constexpr std::size_t frequency_field = 1;

[[noreturn]] void unknown_extension(std::string_view type) {
  std::string known;
  for (auto const& candidate : known_types()) {
    if (!is_extension(candidate.type)) continue;
    known += fmt::format("{} {}", known.empty() ? "" : ",", candidate.type);
  }
  throw Error(fmt::format("{}: no such object; known:{}", type, known));
}

InputObject from_idf(ObjectType const& type, std::vector<std::string> const& values) {
  InputObject object{std::string(type.type), {}, {}, {}};
  if (is_extension(type.type) && type.list.empty() && values.size() > type.fields.size()) {
    bool const named = type.fields.front() == "name";
    throw Error(fmt::format("{}{}{}: {} fields, expected {} at most", type.type, named ? " " : "",
                            named ? values.front() : "", values.size(), type.fields.size()));
  }
  std::size_t const own = std::min(values.size(), type.fields.size());
  for (std::size_t i = 0; i < own; ++i) {
    object.fields.emplace(type.fields[i], values[i]);
  }
  if (!type.list.empty()) {
    for (std::size_t i = own; i < values.size(); ++i) object.list.push_back(values[i]);
  }
  object.name = object["name"];
  return object;
}

std::string text_of(nlohmann::json const& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

InputObject from_epjson(ObjectType const& type, std::string const& name,
                        nlohmann::json const& fields) {
  InputObject object{std::string(type.type), {}, {}, {}};
  for (auto const& [field, value] : fields.items()) {
    if (is_extension(type.type) && field != type.list &&
        std::find(type.fields.begin(), type.fields.end(), field) == type.fields.end()) {
      throw Error(fmt::format("{} {}: {}: no such field", type.type, name, field));
    }
    if (value.is_primitive()) object.fields[field] = text_of(value);
  }
  if (!type.fields.empty() && type.fields.front() == "name") {
    object.name = name;
    object.fields["name"] = name;
  }
  if (!type.list.empty() && fields.contains(type.list)) {
    for (auto const& item : fields.at(std::string(type.list))) {
      object.list.push_back(text_of(item.at(std::string(type.list_field))));
    }
  }
  // The layers of a construction are fields of their own there.
  if (type.type == "Construction") {
    constexpr int most_layers = 10;
    for (int layer = 1; layer <= most_layers; ++layer) {
      auto const field = layer == 1 ? "outside_layer" : fmt::format("layer_{}", layer);
      if (fields.contains(field)) object.list.push_back(text_of(fields.at(field)));
    }
  }
  return object;
}

}  // namespace

std::vector<InputObject> read_idf(std::string_view text) {
  std::vector<InputObject> objects;
  for (auto const& object : parse_idf(text)) {
    if (auto const* type = find_type(object.type)) {
      objects.push_back(from_idf(*type, object.fields));
    } else if (is_extension(object.type)) {
      unknown_extension(object.type);
    }
  }
  return objects;
}

std::vector<InputObject> read_epjson(nlohmann::json const& model) {
  std::vector<InputObject> objects;
  for (auto const& [type_name, instances] : model.items()) {
    auto const* type = find_type(type_name);
    if (type == nullptr && is_extension(type_name)) unknown_extension(type_name);
    if (type == nullptr || !instances.is_object()) continue;
    for (auto const& [name, fields] : instances.items()) {
      objects.push_back(from_epjson(*type, name, fields));
    }
  }
  return objects;
}

std::string rewrite_idf(std::string_view text, Rewrite const& rewrite) {
  std::string result;
  result.reserve(text.size() + 256);
  std::size_t copied = 0;
  bool found = false;
  for (auto const& object : parse_idf(text)) {
    bool const shadow = same_name(object.type, shadow_calculation);
    if (!shadow && !is_extension(object.type)) continue;
    result += text.substr(copied, object.begin - copied);
    copied = object.end;
    if (!shadow) continue;
    found = true;
    auto fields = object.fields;
    fields.resize(std::max(fields.size(), frequency_field + 1));
    fields[method_field] = rewrite.shading_method;
    if (!rewrite.update_frequency.empty()) fields[frequency_field] = rewrite.update_frequency;
    result += format_idf(object.type, fields);
  }
  result += text.substr(copied);
  if (!found) {
    result += '\n';
    result += format_idf(shadow_calculation, {rewrite.shading_method, rewrite.update_frequency});
  }
  return result;
}

void rewrite_epjson(nlohmann::json& model, Rewrite const& rewrite) {
  std::vector<std::string> extensions;
  std::string shadow_key(shadow_calculation);
  for (auto const& [type, instances] : model.items()) {
    if (is_extension(type)) extensions.push_back(type);
    if (same_name(type, shadow_calculation)) shadow_key = type;
  }
  for (auto const& type : extensions) model.erase(type);
  auto& instances = model[shadow_key];
  if (instances.empty()) instances["ShadowCalculation 1"] = nlohmann::json::object();
  for (auto& fields : instances) {
    fields["shading_calculation_method"] = rewrite.shading_method;
    if (!rewrite.update_frequency.empty()) {
      fields["shading_calculation_update_frequency_method"] = rewrite.update_frequency;
    }
  }
}

}  // namespace gpu_shading::energyplus
