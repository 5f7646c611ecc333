#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/idf/field_changes.h"
#include "model/idf/idf_text.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/idf/new_object.h"

namespace gpu_shading::energyplus {

// Objects of the known types and every extension object, in the model's order. Throws Error if the
// dictionary does not allow an extension object.
std::vector<InputObject> read_idf(std::string_view text);
std::vector<InputObject> read_idf(std::vector<IdfObject> const& parsed);
std::vector<InputObject> read_epjson(nlohmann::json const& model);

// A string's characters; other values as JSON.
std::string text_of(nlohmann::json const& value);

// Throws Error unless a value is an object, as each of EnergyPlus's is.
void require_object(nlohmann::json const& value, std::string_view type, std::string_view name);

// What the library says of text that it cannot read, without the name of its exception.
std::string reason_of(nlohmann::json::exception const& error);

// Throws Error for JSON in the place of an IDF.
void refuse_json(std::string_view text);

// Parses epJSON. Throws Error where it is none, and where an extension object or one of its fields
// is given twice, of which all but the last would be lost.
nlohmann::json parse_epjson(std::string_view text);

// The objects of known types (known_types) and every extension object in a model's file. Throws
// Error, naming the file, also for the text of an IDF as check_idf_text() does.
std::vector<InputObject> read_objects(std::filesystem::path const& path);

// Throws Error unless it is a file with the ending of a model.
void require_model(std::filesystem::path const& model);

// By the ending of the file's name.
bool is_epjson(std::filesystem::path const& path);
bool is_idf(std::filesystem::path const& path);

// What EnergyPlus reads in place of the model that the user wrote.
struct Rewrite {
  std::vector<FieldChange> changes;
  Names left_out = {};  // detailed shading surfaces, with their ShadingProperty:Reflectance
  std::vector<NewObject> added = {};
  // A file with more objects, of the same kind as the model.
  std::optional<std::filesystem::path> objects = std::nullopt;
};

// Fields changed, also of the objects of the file; extension objects and the surfaces that are left
// out taken out; objects added. Everything else stays as it is, to the byte in the case of an IDF,
// where a changed object keeps its lines. `parsed`: the text's objects.
std::string rewrite_idf(std::string_view text, std::vector<IdfObject> const& parsed,
                        Rewrite const& rewrite);
void rewrite_epjson(nlohmann::json& model, Rewrite const& rewrite);

}  // namespace gpu_shading::energyplus
