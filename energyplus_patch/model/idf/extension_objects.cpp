#include "model/idf/extension_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/extensions/field.h"
#include "model/idf/idf_text.h"
#include "model/idf/model_file.h"
#include "model/idf/model_text.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view name_field = "name";

ExtensionType const& find_extension_type(std::string_view type) {
  for (auto const& candidate : extension_types()) {
    if (same_name(candidate.type, type)) return candidate;
  }
  std::vector<std::string> known;
  for (auto const& candidate : extension_types()) known.emplace_back(candidate.type);
  throw Error(fmt::format("{}: no such object; known: {}{}", type, fmt::join(known, ", "),
                          did_you_mean(type, known)));
}

bool is_named(ExtensionType const& type) { return type.fields.front()->key == name_field; }

std::string item_title(ExtensionType const& type, std::size_t index) {
  return fmt::format("{} {}", type.list_field->title, index + 1);
}

// For both kinds of file.
// Also asks about decimal commas.
template <typename Action>
void naming_with_commas(IdfObject const& object, std::string const& title, Action const& action) {
  naming(title, [&] {
    try {
      action();
    } catch (Error const& error) {
      if (!object.has_decimal_comma) throw;
      throw Error(
          fmt::format("{}; is a comma in a number? Numbers take a decimal point", error.what()));
    }
  });
}

void check_object(ExtensionType const& type, InputObject const& object) {
  for (auto const* const field : type.fields) check(*field, object[field->key], field->title);
  if (type.list_field == nullptr) return;
  if (object.list.empty()) check(*type.list_field, "", item_title(type, 0));
  for (std::size_t i = 0; i < object.list.size(); ++i) {
    check(*type.list_field, object.list[i], item_title(type, i));
  }
}

// ---- epJSON

// A value, for a message.
std::string shown(nlohmann::json const& value) {
  if (value.is_string()) return "the text " + in_quotes(value.get<std::string>());
  auto const text = in_quotes(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  return text.substr(1, text.size() - 2);
}

bool accepts_text(FieldInfo const& field, std::string const& text) {
  if (field.kind == FieldKind::text || field.any_text) return true;
  if (field.words.empty()) return false;
  if (text.empty()) return !field.required;
  return std::ranges::find(field.words, text) != field.words.end();
}

bool accepts_number(FieldInfo const& field) {
  return field.kind == FieldKind::integer || field.kind == FieldKind::real;
}

// As text, which check() then checks.
std::string text_of_value(FieldInfo const& field, nlohmann::json const& value,
                          std::string_view title) {
  if (value.is_string() && accepts_text(field, value.get<std::string>())) return value;
  if (value.is_number() && accepts_number(field)) return value.dump();
  throw Error(fmt::format("{} is {}, expected {}", title, shown(value), expectation(field)));
}

std::vector<std::string> list_of(ExtensionType const& type, nlohmann::json const& items) {
  auto const& key = type.list_field->key;
  auto const refuse = [&](std::string_view what, nlohmann::json const& value) {
    throw Error(fmt::format("{} is {}, expected an {} with {}", what, shown(value),
                            &value == &items ? "array of objects" : "object", key));
  };
  if (!items.is_array()) refuse(type.list, items);
  std::vector<std::string> list;
  for (auto const& item : items) {
    auto const title = fmt::format("{}[{}]", type.list, list.size());
    if (!item.is_object() || item.size() != 1 || !item.contains(key)) refuse(title, item);
    list.push_back(text_of_value(*type.list_field, item.front(), item_title(type, list.size())));
  }
  return list;
}

FieldInfo const& find_field(ExtensionType const& type, std::string_view key) {
  for (auto const* const field : type.fields) {
    if (field->key == key && key != name_field) return *field;
  }
  std::vector<std::string> known;
  for (auto const* const field : type.fields) {
    if (field->key != name_field) known.emplace_back(field->key);
  }
  if (type.list_field != nullptr) known.emplace_back(type.list);
  throw Error(fmt::format("{}: no such field; known: {}{}", in_quotes(key), fmt::join(known, ", "),
                          did_you_mean(key, known)));
}

InputObject from_epjson(ExtensionType const& type, std::string const& name,
                        nlohmann::json const& fields) {
  InputObject object{std::string(type.type), {}, {}, {}};
  if (is_named(type)) {
    object.name = name;
    object.fields.emplace(name_field, name);
  }
  naming(object.title(), [&] {
    if (!fields.is_object()) {
      throw Error(fmt::format("is {}, expected an object with fields", shown(fields)));
    }
    for (auto const& [key, value] : fields.items()) {
      if (type.list_field != nullptr && key == type.list) {
        object.list = list_of(type, value);
      } else {
        auto const& field = find_field(type, key);
        object.fields.emplace(key, text_of_value(field, value, field.title));
      }
    }
    check_object(type, object);
  });
  return object;
}

// Without the byte order mark, lines ended by \n.
std::string normalised(std::string text) {
  refuse_utf16(text);
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      lines += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      lines += '\n';
    }
  }
  return lines;
}

[[noreturn]] void foreign(std::string_view type) {
  throw Error(
      fmt::format("{}: only {}... objects belong in this file", printable(type), extension_prefix));
}

bool is_version(std::string_view type) { return same_name(type, "Version"); }

std::vector<InputObject> read_idf_extensions(std::string_view text) {
  refuse_json(text);
  auto objects = parse_idf(text);
  for (auto const& object : objects) {
    if (!is_extension(object.type) && !is_version(object.type)) foreign(object.type);
    auto const cut = std::ranges::find_if(
        object.fields, [](auto const& field) { return field.find('\n') != std::string::npos; });
    if (!object.is_closed || cut != object.fields.end()) {
      auto const name = object.fields.empty() ? "" : " " + printable(object.fields.front());
      throw Error(fmt::format("{}{}: is not ended by ;", object.type, name));
    }
  }
  std::erase_if(objects, [](IdfObject const& object) { return is_version(object.type); });
  return read_idf(objects);
}

std::vector<InputObject> read_epjson_extensions(std::string_view text) {
  auto const model = parse_epjson(text);
  if (!model.is_object()) throw Error("expected an object of objects");
  for (auto const& [type, instances] : model.items()) {
    if (!is_extension(type) && !is_version(type)) foreign(type);
  }
  return read_epjson(model);
}

}  // namespace

InputObject read_extension(IdfObject const& object) {
  auto const& type = find_extension_type(object.type);
  InputObject result{std::string(type.type), {}, {}, {}};
  auto const& values = object.fields;
  if (is_named(type) && !values.empty()) result.name = values.front();
  naming_with_commas(object, result.title(), [&] {
    if (type.list_field == nullptr && values.size() > type.fields.size()) {
      throw Error(fmt::format("{} fields, expected {} at most", values.size(), type.fields.size()));
    }
    for (std::size_t i = 0; i < std::min(values.size(), type.fields.size()); ++i) {
      result.fields.emplace(type.fields[i]->key, values[i]);
    }
    for (std::size_t i = type.fields.size(); i < values.size(); ++i) {
      result.list.push_back(values[i]);
    }
    // Blank fields at the end mean nothing.
    while (!result.list.empty() && result.list.back().empty()) result.list.pop_back();
    check_object(type, result);
  });
  return result;
}

std::vector<InputObject> read_extensions(std::string_view type_name,
                                         nlohmann::json const& instances) {
  auto const& type = find_extension_type(type_name);
  if (!instances.is_object()) {
    throw Error(
        fmt::format("{}: is {}, expected an object of objects", type.type, shown(instances)));
  }
  std::vector<InputObject> objects;
  for (auto const& [name, fields] : instances.items()) {
    objects.push_back(from_epjson(type, name, fields));
  }
  return objects;
}

void check_unique(std::vector<InputObject> const& objects) {
  std::set<std::pair<std::string, std::string>> seen;
  for (auto const& object : objects) {
    if (!is_extension(object.type)) continue;
    if (seen.emplace(object.type, upper(object.name)).second) continue;
    throw Error(fmt::format("{}: given twice, expected {}", object.where(),
                            object.name.empty() ? "once at most" : "one object of this name"));
  }
}

std::vector<InputObject> read_side_file(std::filesystem::path const& path) {
  auto text = read_text_file(path);
  return naming(path.string(), [&] {
    auto const lines = normalised(std::move(text));
    return is_epjson(path) ? read_epjson_extensions(lines) : read_idf_extensions(lines);
  });
}

}  // namespace gpu_shading::energyplus
