#include "input/model_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view shadow_calculation = "ShadowCalculation";
constexpr std::string_view reflectance = "ShadingProperty:Reflectance";
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

void read_list(ObjectType const& type, nlohmann::json const& items,
               std::vector<std::string>& list) {
  auto const add = [&](nlohmann::json const& item, std::string const& field) {
    list.push_back(item.contains(field) ? text_of(item.at(field)) : "");
  };
  for (auto const& item : items) {
    if (type.list_field.empty()) {
      for (char const* field :
           {"vertex_x_coordinate", "vertex_y_coordinate", "vertex_z_coordinate"}) {
        add(item, field);
      }
    } else {
      list.push_back(text_of(item.at(std::string(type.list_field))));
    }
  }
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
    read_list(type, fields.at(std::string(type.list)), object.list);
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

bool goes(std::string_view type, std::string const& surface, Names const& left_out) {
  bool const is_surface = type.size() > 8 && same_name(type.substr(0, 8), "Shading:") &&
                          same_name(type.substr(type.rfind(':')), ":Detailed");
  return (is_surface || same_name(type, reflectance)) && left_out.contains(upper(surface));
}

bool goes(IdfObject const& object, Names const& left_out) {
  return !left_out.empty() && !object.fields.empty() &&
         goes(object.type, object.fields.front(), left_out);
}

void take_out(nlohmann::json& model, Names const& left_out) {
  std::vector<std::string> emptied;
  for (auto const& [type, instances] : model.items()) {
    if (!instances.is_object()) continue;
    for (auto instance = instances.begin(); instance != instances.end();) {
      bool const named_by_field = same_name(type, reflectance);
      auto const& name = named_by_field && instance->contains("shading_surface_name")
                             ? text_of(instance->at("shading_surface_name"))
                             : instance.key();
      instance = goes(type, name, left_out) ? instances.erase(instance) : std::next(instance);
    }
    if (instances.empty()) emptied.push_back(type);
  }
  for (auto const& type : emptied) model.erase(type);
}

}  // namespace

std::vector<InputObject> read_idf(std::string_view text) { return read_idf(parse_idf(text)); }

std::vector<InputObject> read_idf(std::vector<IdfObject> const& parsed) {
  std::vector<InputObject> objects;
  for (auto const& object : parsed) {
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
  return rewrite_idf(text, parse_idf(text), rewrite);
}

std::string rewrite_idf(std::string_view text, std::vector<IdfObject> const& parsed,
                        Rewrite const& rewrite) {
  std::string result;
  result.reserve(text.size() + 256);
  std::size_t copied = 0;
  bool found = false;
  for (auto const& object : parsed) {
    bool const shadow = same_name(object.type, shadow_calculation);
    if (!shadow && !is_extension(object.type) && !goes(object, rewrite.left_out)) continue;
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
  if (!rewrite.placeholders.empty()) result += '\n';
  for (auto const& placeholder : rewrite.placeholders) {
    result += format_idf(placeholder_type, placeholder_fields(placeholder));
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
  if (!rewrite.left_out.empty()) take_out(model, rewrite.left_out);
  for (auto const& placeholder : rewrite.placeholders) {
    model[placeholder_type][placeholder.name] = placeholder_json(placeholder);
  }
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
