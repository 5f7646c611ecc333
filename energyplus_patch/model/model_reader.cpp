#include "model/model_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "files/unconfined_decoding.h"
#include "gpu_shading/error.h"
#include "model/energyplus_rays.h"
#include "model/extensions/extension_fields.h"
#include "model/geometry_rules.h"
#include "model/idf/extension_objects.h"
#include "model/idf/local_environment.h"
#include "model/input/plausible_lengths.h"
#include "model/reflected_light_plan.h"
#include "model/reflex_corners.h"
#include "model/site/farthest_coordinate.h"
#include "model/site/site_clock.h"
#include "model/site/texture_axes.h"
#include "platform/files.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Shades and screens find them by name, like the model's own surfaces.
void add_surroundings(Surroundings const& surroundings, ShadingInput& shading) {
  for (auto const& [name, type] : surroundings.types) {
    // A crown cannot have another filter.
    if (type == extension::tree::type && !shading.shading_surfaces.contains(name)) continue;
    auto const [entry, added] =
        shading.shading_surfaces.try_emplace(name, ShadingInput::ShadingSurface{.type = type});
    if (!added) {
      throw Error(fmt::format("{}: {} is also the name of a {}", type, name, entry->second.type));
    }
  }
}

constexpr std::string_view side_suffix = ".gpu-shading.idf";

// A tool that renames or moves a model leaves its side file behind.
void remark_on_other_side_files(std::filesystem::path const& model, Model& made) {
  std::error_code error;
  std::vector<std::string> names;
  for (auto entry = std::filesystem::directory_iterator(
           model.has_parent_path() ? model.parent_path() : ".", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    auto name = entry->path().filename().string();
    if (name.ends_with(side_suffix)) names.push_back(std::move(name));
  }
  std::ranges::sort(names);
  if (names.empty()) return;
  made.remarks.push_back(fmt::format("not read, since it does not have the model's name, {}{}: {}",
                                     model.stem().string(), side_suffix, listed(names, 3)));
}

bool any_moves(PerforatedScreens const& screens) {
  return std::ranges::any_of(screens.by_surface, [](auto const& each) {
    return !each.second.deployment_schedule.empty();
  });
}

constexpr std::string_view unconfined_warning =
    "images, meshes and GeoTIFF are decoded without landlock, which this kernel or container "
    "refuses: one that exploits its decoder could read any file of this user, but not change or "
    "send it; see docs/explanation/limits.md";

// What a run with moving shades needs.
void prepare_for_moving_shades(Model& model) {
  if (model.moving_shades.empty()) return;
  auto const& first = model.moving_shades.front();
  auto& options = model.options;
  options.update.every_timestep = true;
  // Single directions keep no GPU busy.
  if (options.mode != Mode::require && !options.device.device) options.device.device = DeviceId{};
  for (auto const& shade : model.moving_shades) model.remarks.push_back(shade.describe());
  model.remarks.emplace_back(
      "with moving shades, shading is computed at every timestep, on the CPU unless a GPU is named "
      "or required");
  if (!model.shading.detailed_sky && options.sky == SkyModel::energyplus) {
    model.warnings.push_back(fmt::format(
        "{}: with SimpleSkyDiffuseModeling, the diffuse light of the sky is that of the position "
        "at rest; ShadowCalculation: Sky Diffuse Modeling Algorithm = DetailedSkyDiffuseModeling "
        "follows the motion",
        first.where));
  }
}

// A user's own factors stay.
void add_surrounding_objects(Choices const& choices, Model& model) {
  if (!choices.surrounding_objects) {
    if (!model.surrounding_groups.empty() && !choices.task) {
      model.remarks.push_back(fmt::format("{} applies with --gpu-shading-surroundings only",
                                          model.surrounding_groups.front().where));
    }
    return;
  }
  model.surrounding_objects = choices.surrounding_objects;
  constexpr std::string_view warning = "warning: ";
  std::ifstream messages(choices.surrounding_objects->parent_path() / surroundings_messages);
  for (std::string line; std::getline(messages, line);) {
    if (line.starts_with(warning)) {
      model.warnings.push_back(line.substr(warning.size()));
    } else {
      model.remarks.push_back(fmt::format("long-wave exchange by {}", line));
    }
  }
  if (model.own_environments.empty()) return;
  std::vector<std::string> names(model.own_environments.begin(), model.own_environments.end());
  std::ranges::sort(names);
  model.remarks.push_back(
      fmt::format("{} of the model stays, so that these surfaces get no view factors: {}",
                  local_environment, listed(names, 3)));
}

// The model's own surfaces with a TransparentShade or a PerforatedScreen, or that move.
Names transmitting_surfaces(Model const& model) {
  Names names;
  for (auto const& shade : model.moving_shades) {
    names.insert(shade.surfaces.begin(), shade.surfaces.end());
  }
  for (auto const& [name, shade] : model.shades.by_surface) names.insert(name);
  for (auto const& [name, screen] : model.screens.by_surface) names.insert(name);
  for (auto const& [name, type] : model.surroundings.types) names.erase(name);
  return names;
}

// The surfaces that are in EnergyPlus's input, in order.
std::vector<std::string> kept(Names const& surfaces, LeanInput const& lean) {
  std::vector<std::string> names;
  for (auto const& name : surfaces) {
    if (!lean.left_out.contains(name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

// The objects that add_surrounding_objects() adds; there may be none.
std::vector<InputObject> read_surrounding_objects(Model const& model) {
  if (!model.surrounding_objects) return {};
  auto const text = read_text_file(*model.surrounding_objects);
  return is_epjson(*model.surrounding_objects) ? read_epjson(parse_epjson(text)) : read_idf(text);
}

void add_reflected_light(std::vector<InputObject> const& objects, Reader const& reader,
                         Model& model) {
  auto const more = read_surrounding_objects(model);
  auto plan = plan_reflected_light({objects, more, reader.find_mentions}, model.options,
                                   reader.reflected_light, model.shading);
  model.reflected_light = std::move(plan.input.light);
  model.field_changes = std::move(plan.input.changes);
  model.new_objects = std::move(plan.input.added);
  std::ranges::move(plan.warnings, std::back_inserter(model.warnings));
  std::ranges::move(plan.remarks, std::back_inserter(model.remarks));
}

// Lean input, and warnings about EnergyPlus's rays.
void plan_rays(std::vector<InputObject> const& objects, Reader const& reader, Model& model) {
  bool const on = model.options.mode != Mode::off;
  EnergyPlusRays rays;
  rays.daylighting_answered = reader.daylight_rays && on && has_daylighting(objects) &&
                              daylighting_can_be_answered(objects) && !model.shading.reflections;
  auto const transmitting = transmitting_surfaces(model);
  if (rays.daylighting_answered) rays.transmitting = transmitting;
  if (reader.find_mentions) {
    model.lean = plan_lean_input(objects, model.shading, model.options, rays, reader.find_mentions);
  }
  model.daylighting_answered = rays.daylighting_answered;
  std::optional<std::vector<std::string>> opaque_to_daylight;
  if (rays.daylighting_answered) opaque_to_daylight = kept(transmitting, model.lean);
  model.ray_warnings = warn_of_rays(objects, model.shading, opaque_to_daylight);
}

// Makes EnergyPlus ask about all receivers where it would miss casters.
void add_placeholders(std::vector<InputObject> const& objects, Model& model) {
  auto const misjudged = find_reflex_corners(objects, model.shading, model.lean.left_out);
  if (!misjudged.empty()) {
    model.remarks.push_back(fmt::format(
        "EnergyPlus may miss shadows of or on {} surface{} with a reflex corner at the second or "
        "last but one vertex: {}; placeholders make it ask for all sunlit fractions",
        misjudged.size(), misjudged.size() == 1 ? "" : "s", listed(misjudged, 3)));
  }
  if (!misjudged.empty() || !model.surroundings.empty()) {
    ensure_placeholders(model.lean, model.shading);
  }
}

// Placeholders stand farther from the origin than the model.
void move_placeholders(Model& model) {
  double largest = model.far_outlines.largest();
  for (auto const& caster : model.lean.casters) {
    largest = std::max(largest, largest_coordinate(caster.polygon));
  }
  largest = std::min(largest, farthest_coordinate);
  for (auto& placeholder : model.lean.placeholders) {
    placeholder.distance = std::max(placeholder.distance, 10.0 * largest);
  }
}

}  // namespace

std::optional<std::filesystem::path> find_side_file(std::filesystem::path const& model,
                                                    Choices const& choices) {
  if (choices.file) return choices.file;
  auto sibling_file = model;
  sibling_file.replace_extension(side_suffix);
  // Also a link that leads nowhere: reading it is an error.
  auto const status = std::filesystem::symlink_status(sibling_file);
  return std::filesystem::exists(status) ? std::optional(sibling_file) : std::nullopt;
}

Model understand(std::vector<InputObject> objects, std::filesystem::path const& path,
                 Choices const& choices, Reader const& reader) {
  for (auto& object : objects) {
    if (object.file.empty()) object.file = path.string();
  }
  Model model;
  model.file = path.filename().string();
  take_unconfined_decoding();  // of an earlier model
  auto const side = find_side_file(path, choices);
  if (side) {
    model.remarks.push_back(fmt::format("{}... objects are also read from {}", extension_prefix,
                                        side->filename().string()));
    for (auto& object : read_side_file(*side)) {
      object.file = side->string();
      objects.push_back(std::move(object));
    }
  } else {
    remark_on_other_side_files(path, model);
  }
  check_unique(objects);
  model.shading = read_shading_input(objects);
  auto const folder = choices.folder.value_or(path.parent_path());
  AssetFolder const assets(folder, choices.assets.value_or(Assets::restricted));
  model.surroundings = read_surroundings(objects, assets, reader.horizons);
  add_surroundings(model.surroundings, model.shading);
  for (auto& line : warn_of_lengths(objects)) model.warnings.push_back(std::move(line));
  model.shades = read_transparent_shades(objects, model.shading, folder);
  model.screens = read_perforated_screens(objects, model.shading, model.shades, assets);
  check_textures(model.surroundings, model.screens);
  if (take_unconfined_decoding()) model.warnings.emplace_back(unconfined_warning);
  model.moving_shades = read_moving_shades(objects, model.shading, model.surroundings.types);
  model.surrounding_groups = read_surrounding_groups(objects);
  model.own_environments = surfaces_with_environment(objects);
  if (choices.positions) {
    set_rest(model.moving_shades, "--gpu-shading-positions", *choices.positions);
  }
  model.pv_modules = read_pv_modules(objects, model.shading);
  model.options = resolve(choices, read_settings(objects), model.shading);
  add_surrounding_objects(choices, model);
  add_reflected_light(objects, reader, model);
  plan_rays(objects, reader, model);
  if (model.options.mode != Mode::off) {
    if (reader.release) {
      auto warning = check_supported(model.shading, model.file, *reader.release);
      if (!warning.empty()) model.early_warnings.push_back(std::move(warning));
    }
    check_location(objects);
    model.transform_warning = warn_of_transform(objects);
    model.simplified = find_simplified_surfaces(objects, model.shading, model.lean.left_out);
    if (!model.simplified.warning.empty()) {
      model.early_warnings.push_back(model.simplified.warning);
    }
    model.far_outlines = FarOutlines(objects, model.shading, model.lean.left_out);
    add_placeholders(objects, model);
    prepare_for_moving_shades(model);
    for (auto const& modules : model.pv_modules) model.remarks.push_back(modules.describe());
    if (model.options.weighs_sky_patches()) model.options.update.every_timestep = true;
    if (choices.pv) {
      model.pv_reductions = read_pv_reductions(*choices.pv, objects, model.shading);
      model.options.update.every_timestep = true;
    }
    // Without the placeholder, EnergyPlus multiplies our view factors by the sky's ratios, or does
    // not, by a schedule's value at the start of the day (SkyRatios).
    bool const given_views = model.surrounding_objects || has_views(objects);
    if (model.shading.detailed_sky &&
        (any_moves(model.screens) || !model.moving_shades.empty() || given_views)) {
      add_sky_placeholder(model.lean, model.shading);
    }
    move_placeholders(model);
  }
  return model;
}

Model read_model(std::filesystem::path const& path, Choices const& choices, Reader const& reader) {
  auto objects = read_objects(path);
  if (!objects.empty() && std::ranges::all_of(objects, is_extension, &InputObject::type)) {
    throw Error(
        fmt::format("{}: has {}... objects alone, expected a model: give this file by "
                    "--gpu-shading-file",
                    path.string(), extension_prefix));
  }
  return understand(std::move(objects), path, choices, reader);
}

Rewrite rewrite_for(Model const& model) {
  auto const& options = model.options;
  Rewrite rewrite{shading_method(options.mode == Mode::off ? "PolygonClipping" : "PixelCounting",
                                 options.update.every_timestep ? "Timestep" : ""),
                  model.lean.left_out, model.new_objects, model.surrounding_objects};
  rewrite.changes.insert(rewrite.changes.end(), model.field_changes.begin(),
                         model.field_changes.end());
  auto const& placeholders = model.lean.placeholders;
  for (auto const& name : own_schedules(placeholders, model.surroundings.leaf_schedules)) {
    std::ranges::move(schedule_objects(name), std::back_inserter(rewrite.added));
  }
  for (auto const& placeholder : placeholders) {
    rewrite.added.push_back(placeholder_object(placeholder));
  }
  return rewrite;
}

}  // namespace gpu_shading::energyplus
