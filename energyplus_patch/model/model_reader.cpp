#include "model/model_reader.h"

#include <fmt/format.h>

#include "gpu_shading/error.h"
#include "idf/extension_objects.h"
#include "idf/model_file.h"
#include "idf/side_file.h"
#include "model/ray_warnings.h"
#include "site/texture_axes.h"

namespace gpu_shading::energyplus {
namespace {

// Shades and screens find them by name, like the model's own surfaces.
void add_surroundings(Surroundings const& surroundings, ShadingInput& shading) {
  for (auto const& [name, type] : surroundings.types) {
    auto const [place, added] =
        shading.shading_surfaces.try_emplace(name, ShadingInput::ShadingSurface{type, ""});
    if (!added) {
      throw Error(fmt::format("{}: {} is also the name of a {}", type, name, place->second.type));
    }
  }
}

}  // namespace

std::optional<std::filesystem::path> find_side_file(std::filesystem::path const& model,
                                                    Choices const& choices) {
  if (choices.file) return choices.file;
  auto beside = model;
  beside.replace_extension(".gpu-shading.idf");
  // Also a link that leads nowhere: reading it is an error.
  auto const status = std::filesystem::symlink_status(beside);
  return std::filesystem::exists(status) ? std::optional(beside) : std::nullopt;
}

Model understand(std::vector<InputObject> objects, std::filesystem::path const& path,
                 Choices const& choices, MentionFinder const& find_mentions) {
  for (auto& object : objects) {
    if (object.file.empty()) object.file = path.string();
  }
  if (auto const side = find_side_file(path, choices)) {
    for (auto& object : read_side_file(*side)) {
      object.file = side->string();
      objects.push_back(std::move(object));
    }
  }
  check_unique(objects);
  Model model;
  model.shading = read_shading_input(objects);
  auto const folder = choices.folder.value_or(path.parent_path());
  model.surroundings = read_surroundings(objects, folder);
  add_surroundings(model.surroundings, model.shading);
  model.shades = read_transparent_shades(objects, model.shading, folder);
  model.screens = read_perforated_screens(objects, model.shading, model.shades, folder);
  check_textures(model.surroundings, model.screens);
  model.ray_warnings = warn_of_rays(objects, model.shading);
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
