#include "input/model_reader.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "gpu_shading/error.h"
#include "input/model_file.h"
#include "site/texture_axes.h"

namespace gpu_shading::energyplus {
namespace {

std::string read_text(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) throw Error(fmt::format("{}: cannot be read", path.string()));
  return text;
}

void add_side_file(std::filesystem::path const& path, std::vector<InputObject>& objects) {
  for (auto& object : read_objects(path)) {
    if (!is_extension(object.type)) {
      throw Error(fmt::format("{}: {}: only {}... objects belong in this file", path.string(),
                              object.type, extension_prefix));
    }
    objects.push_back(std::move(object));
  }
}

// Shades and screens find them by name like the model's own.
void add_surroundings(Surroundings const& surroundings, ShadingInput& shading) {
  for (auto const& [name, type] : surroundings.types) {
    auto const [place, added] =
        shading.shading_surfaces.try_emplace(name, ShadingInput::ShadingSurface{type, ""});
    if (!added) {
      throw Error(fmt::format("{}: {} is the name of a {} too", type, name, place->second.type));
    }
  }
}

}  // namespace

std::vector<InputObject> read_objects(std::filesystem::path const& path) {
  auto const text = read_text(path);
  if (!is_epjson(path)) return read_idf(text);
  try {
    return read_epjson(nlohmann::json::parse(text));
  } catch (nlohmann::json::exception const& error) {
    throw Error(fmt::format("{}: {}", path.string(), error.what()));
  }
}

std::optional<std::filesystem::path> find_side_file(std::filesystem::path const& model,
                                                    Choices const& choices) {
  if (choices.file) return choices.file;
  auto beside = model;
  beside.replace_extension(".gpu-shading.idf");
  return std::filesystem::exists(beside) ? std::optional(beside) : std::nullopt;
}

bool is_epjson(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".epJSON") ||
         same_name(path.extension().string(), ".json");
}

bool is_idf(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".idf") ||
         same_name(path.extension().string(), ".imf");
}

Model understand(std::vector<InputObject> objects, std::filesystem::path const& path,
                 Choices const& choices, MentionFinder const& find_mentions) {
  if (auto const side = find_side_file(path, choices)) add_side_file(*side, objects);
  Model model;
  model.shading = read_shading_input(objects);
  auto const folder = choices.folder.value_or(path.parent_path());
  model.surroundings = read_surroundings(objects, folder);
  add_surroundings(model.surroundings, model.shading);
  model.shades = read_transparent_shades(objects, model.shading, folder);
  model.screens = read_perforated_screens(objects, model.shading, model.shades, folder);
  check_textures(model.surroundings, model.screens);
  model.options = resolve(choices, read_settings(objects), model.shading);
  if (find_mentions) {
    model.lean = plan_lean_input(objects, model.shading, model.options, find_mentions);
  }
  if (!model.surroundings.empty() && model.options.mode != Mode::off) {
    ensure_placeholders(model.lean, model.shading);
  }
  return model;
}

Model read_model(std::filesystem::path const& path, Choices const& choices) {
  return understand(read_objects(path), path, choices);
}

}  // namespace gpu_shading::energyplus
