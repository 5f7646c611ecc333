#include "model/idf/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "gpu_shading/error.h"
#include "model/idf/extension_objects.h"
#include "model/idf/model_text.h"
#include "platform/files.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view reflectance = "ShadingProperty:Reflectance";

InputObject from_idf(ObjectType const& type, std::vector<std::string> const& values) {
  InputObject object{std::string(type.type), {}, {}, {}};
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

void read_list(ObjectType const& type, nlohmann::json const& items,
               std::vector<std::string>& list) {
  if (!items.is_array())
    throw Error(fmt::format("{}: {}: expected an array", type.type, type.list));
  for (auto const& item : items) {
    require_object(item, type.type, type.list);
    for (auto const field : type.list_fields) {
      auto const found = item.find(field);
      list.push_back(found == item.end() ? "" : text_of(*found));
    }
  }
}

InputObject from_epjson(ObjectType const& type, std::string const& name,
                        nlohmann::json const& fields) {
  require_object(fields, type.type, name);
  InputObject object{std::string(type.type), {}, {}, {}};
  for (auto const& [field, value] : fields.items()) {
    if (value.is_primitive()) object.fields[field] = text_of(value);
  }
  if (!type.fields.empty() && type.fields.front() == "name") {
    object.name = name;
    object.fields["name"] = name;
  }
  if (!type.list.empty() && fields.contains(type.list)) {
    read_list(type, fields.at(std::string(type.list)), object.list);
  }
  // In epJSON, each layer of a construction is a separate field.
  if (type.type == "Construction") {
    constexpr int max_layers = 10;
    for (int layer = 1; layer <= max_layers; ++layer) {
      auto const field = layer == 1 ? "outside_layer" : fmt::format("layer_{}", layer);
      if (fields.contains(field)) object.list.push_back(text_of(fields.at(field)));
    }
  }
  return object;
}

// The first that is not white space.
std::optional<char> first_character(std::string_view text) {
  auto const at = text.find_first_not_of(" \t\r\n");
  return at == std::string_view::npos ? std::nullopt : std::optional(text[at]);
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

// EnergyPlus's messages count lines, and its parser takes quadratic time over blank lines before a
// comment, but linear time over comments.
std::string comment_lines(std::ptrdiff_t lines) {
  std::string text;
  for (; lines > 0; --lines) text += "!\n";
  return text;
}

// Whether nothing but blanks comes before the next line.
bool ends_line(std::string_view text) {
  auto const next = text.find_first_not_of(" \t\r");
  return next == std::string_view::npos || text[next] == '\n';
}

// In as many lines as before, with a field on each.
std::string in_lines(std::string const& type, std::vector<std::string> const& fields,
                     std::ptrdiff_t lines) {
  std::string text = type;
  for (auto const& field : fields) {
    text += lines > 0 ? ",\n  " : ",";
    text += field;
    if (lines > 0) --lines;
  }
  return text + ";" + (lines > 0 ? "\n" : "") + comment_lines(lines - 1);
}

// The text without what goes, and with changed fields.
std::string edited(std::string_view text, std::vector<IdfObject> const& parsed,
                   FieldChanges& changes, Names const& left_out) {
  std::string result;
  result.reserve(text.size() + 256);
  std::size_t copied = 0;
  for (auto const& object : parsed) {
    bool const is_removed = is_extension(object.type) || goes(object, left_out);
    auto fields = object.fields;
    if (!is_removed && !changes.apply(object.type, fields)) continue;
    result += text.substr(copied, object.begin - copied);
    copied = object.end;
    auto const lines = std::ranges::count(text.substr(object.begin, copied - object.begin), '\n');
    result += is_removed ? comment_lines(lines) + (ends_line(text.substr(copied)) ? "!" : "")
                         : in_lines(object.type, fields, lines);
  }
  result += text.substr(copied);
  // What follows must not become part of it. EnergyPlus takes a line break for part of a field, so
  // there is one only after a comment.
  bool const is_open = !parsed.empty() && !parsed.back().is_closed && copied < text.size();
  bool const in_comment = text.substr(text.rfind('\n') + 1).find('!') != std::string_view::npos;
  if (is_open) result += in_comment ? "\n;\n" : ";\n";
  return result;
}

std::vector<InputObject> read_checked_idf(std::string_view text) {
  refuse_json(text);
  auto const parsed = parse_idf(text);
  check_idf_text(text, parsed);
  return read_idf(parsed);
}

std::vector<InputObject> read_checked_epjson(std::string_view text) {
  auto const model = parse_epjson(text);
  check_epjson(model);
  return read_epjson(model);
}

}  // namespace

std::vector<InputObject> read_idf(std::string_view text) {
  refuse_json(text);
  return read_idf(parse_idf(text));
}

std::vector<InputObject> read_idf(std::vector<IdfObject> const& parsed) {
  std::vector<InputObject> objects;
  for (auto const& object : parsed) {
    if (is_extension(object.type)) {
      objects.push_back(read_extension(object));
    } else if (auto const* type = find_type(object.type)) {
      objects.push_back(from_idf(*type, object.fields));
    }
  }
  return objects;
}

std::vector<InputObject> read_epjson(nlohmann::json const& model) {
  if (!model.is_object()) {
    throw Error(fmt::format("expected a JSON object, got: {}", model.type_name()));
  }
  std::vector<InputObject> objects;
  for (auto const& [type_name, instances] : model.items()) {
    if (is_extension(type_name)) {
      auto extensions = read_extensions(type_name, instances);
      std::ranges::move(extensions, std::back_inserter(objects));
      continue;
    }
    auto const* type = find_type(type_name);
    if (type == nullptr || !instances.is_object()) continue;
    for (auto const& [name, fields] : instances.items()) {
      objects.push_back(from_epjson(*type, name, fields));
    }
  }
  return objects;
}

std::vector<InputObject> read_objects(std::filesystem::path const& path) {
  auto const text = read_text_file(path);
  return naming(path.string(), [&] {
    auto objects = is_epjson(path) ? read_checked_epjson(text) : read_checked_idf(text);
    for (auto& object : objects) object.file = path.string();
    return objects;
  });
}

void require_model(std::filesystem::path const& model) {
  require_file(model);
  if (is_idf(model) || is_epjson(model)) return;
  struct OtherFile {
    std::string_view ending;
    std::string_view kind;
    std::string_view action;
  };
  constexpr std::array<OtherFile, 3> others{{
      {".osm", "is an OpenStudio model; ", ": export it as IDF from OpenStudio"},
      {".hbjson", "is a Honeybee model; ",
       ": translate it with honeybee-energy translate model-to-idf"},
      {".epw", "is a weather file; ", ": -w names the weather file"},
  }};
  auto const ending = model.extension().string();
  auto const* const other = std::ranges::find_if(
      others, [&](OtherFile const& each) { return same_name(each.ending, ending); });
  bool const known = other != others.end();
  throw Error(fmt::format("{}: {}expected an .idf or .epJSON file{}", model.string(),
                          known ? other->kind : "", known ? other->action : ""));
}

void require_object(nlohmann::json const& value, std::string_view type, std::string_view name) {
  if (value.is_object()) return;
  throw Error(fmt::format("{} {}: expected an object with fields", type, in_quotes(name)));
}

std::string text_of(nlohmann::json const& value) {
  constexpr auto replace = nlohmann::json::error_handler_t::replace;
  return value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, replace);
}

void refuse_json(std::string_view text) {
  if (first_character(text) == '{') throw Error("is JSON: epJSON needs the ending .epJSON");
}

std::string reason_of(nlohmann::json::exception const& error) {
  // "[json.exception.parse_error.101] reason"
  std::string_view const text = error.what();
  constexpr std::string_view mark = "] ";
  return std::string(text.substr(text.find(mark) + mark.size()));
}

nlohmann::json parse_epjson(std::string_view text) {
  constexpr int max_depth = 100;
  // Keys of extension objects at the depths of types, of names, and of fields and below.
  std::vector<std::set<std::string>> keys;
  std::string title;
  bool is_ours = false;
  auto const watch = [&](int depth, nlohmann::json::parse_event_t event,
                         nlohmann::json const& parsed) {
    auto const level = static_cast<std::size_t>(depth);
    if (depth > max_depth) throw Error(fmt::format("is nested more than {} deep", max_depth));
    // Its keys come a level deeper.
    if (event == nlohmann::json::parse_event_t::object_start) keys.resize(level + 1);
    if (event != nlohmann::json::parse_event_t::key) return true;
    auto const key = parsed.get<std::string>();
    keys.resize(level + 1);
    if (level == 1) {
      is_ours = is_extension(key);
      title = key;
    }
    if (is_ours && !keys[level].insert(key).second) {
      throw Error(fmt::format("{}: \"{}\" is given twice", title, key));
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text, watch);
  } catch (nlohmann::json::exception const& error) {
    if (auto const first = first_character(text); first && *first != '{' && *first != '[') {
      throw Error("is not JSON: an IDF needs the ending .idf");
    }
    throw Error(fmt::format("is not valid JSON: {}", reason_of(error)));
  }
}

bool is_epjson(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".epJSON") ||
         same_name(path.extension().string(), ".json");
}

bool is_idf(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".idf") ||
         same_name(path.extension().string(), ".imf");
}

std::string rewrite_idf(std::string_view text, std::vector<IdfObject> const& parsed,
                        Rewrite const& rewrite) {
  FieldChanges changes(rewrite.changes);
  auto result = edited(text, parsed, changes, rewrite.left_out);
  std::string file;
  if (rewrite.objects) {
    auto const objects = read_text_file(*rewrite.objects);
    file = edited(objects, parse_idf(objects), changes, {});
  }
  std::string added;
  for (auto const& object : changes.missing()) added += format_idf(object.type, idf_fields(object));
  for (auto const& object : rewrite.added) added += format_idf(object.type, idf_fields(object));
  added += file;
  if (!added.empty()) result += '\n' + added;
  return result;
}

void rewrite_epjson(nlohmann::json& model, Rewrite const& rewrite) {
  std::vector<std::string> extensions;
  for (auto const& [type, instances] : model.items()) {
    if (is_extension(type)) extensions.push_back(type);
  }
  for (auto const& type : extensions) model.erase(type);
  if (!rewrite.left_out.empty()) take_out(model, rewrite.left_out);
  for (auto const& object : rewrite.added) add_object(model, object);
  if (rewrite.objects) model.merge_patch(parse_epjson(read_text_file(*rewrite.objects)));
  apply_changes(model, rewrite.changes);
}

}  // namespace gpu_shading::energyplus
