#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/idf/idf_text.h"
#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/idf/placeholders.h"

namespace gpu_shading::energyplus {

// Objects of the known types and every extension object, in the model's order. Throws Error if the
// dictionary does not allow an extension object.
std::vector<InputObject> read_idf(std::string_view text);
std::vector<InputObject> read_idf(std::vector<IdfObject> const& parsed);
std::vector<InputObject> read_epjson(nlohmann::json const& model);

// A string's characters; other values as JSON.
std::string text_of(nlohmann::json const& value);

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

// What EnergyPlus shall read instead of the model that the user wrote.
struct Rewrite {
  std::string shading_method;    // PixelCounting or PolygonClipping
  std::string update_frequency;  // Periodic or Timestep; "" keeps the model's
  Names left_out = {};  // detailed shading surfaces, with their ShadingProperty:Reflectance
  std::vector<std::string> schedules = {};     // of ours (own_schedules), added
  std::vector<Placeholder> placeholders = {};  // added
  // A file with more objects, of the same kind as the model.
  std::optional<std::filesystem::path> objects = std::nullopt;
};

// ShadowCalculation changed, or added where there is none, all its other fields kept; extension
// objects and the surfaces that are left out taken out; placeholders and objects added. Everything
// else stays as it is, to the byte in the case of an IDF. `parsed`: the text's objects.
std::string rewrite_idf(std::string_view text, std::vector<IdfObject> const& parsed,
                        Rewrite const& rewrite);
void rewrite_epjson(nlohmann::json& model, Rewrite const& rewrite);

}  // namespace gpu_shading::energyplus
