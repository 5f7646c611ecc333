#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "model/extensions/extension_fields.h"
#include "model/idf/model_file.h"
#include "platform/files.h"
#include "platform/progress.h"
#include "platform/text.h"
#include "reports/map_grid.h"
#include "reports/sky_mask.h"
#include "reports/view_factors.h"
#include "tasks/perform_task.h"
#include "tasks/samples/sky_patches.h"

namespace gpu_shading::energyplus {
namespace {

// The groups of the model's objects, then those by kind, and the group of each surface.
struct Grouping {
  std::vector<ViewedGroup> groups;
  std::vector<std::size_t> group_of;  // by surface of the scene
};

std::string kind_name(std::size_t kind) { return upper(name_of(static_cast<ShadeKind>(kind))); }

std::string original_name(std::string const& surface) {
  return is_mirrored(surface) ? surface.substr(mirrored_name("").size()) : surface;
}

Grouping group(SceneAssembly const& assembly, Scene const& scene) {
  auto const& objects = assembly.model().surrounding_groups;
  constexpr std::string_view ground = "GROUND";
  Grouping made;
  made.groups = {{"SKY"}, {std::string(ground)}};
  std::vector<bool> used(objects.size(), false);
  std::vector<std::size_t> places;  // of the objects' groups
  for (std::size_t i = 0; i < objects.size(); ++i) {
    used[i] = same_name(objects[i].surfaces, ground);
    places.push_back(used[i] ? std::size_t{viewed_ground} : made.groups.size());
    if (!used[i]) made.groups.emplace_back();
    made.groups[places.back()] = {upper(objects[i].name), objects[i].schedule};
  }
  auto const first_kind = made.groups.size();
  for (std::size_t kind = 0; kind < shade_kinds; ++kind) made.groups.push_back({kind_name(kind)});
  auto const kinds = kinds_of(assembly, scene);
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const kind = static_cast<std::size_t>(kinds[id]);
    auto const name = original_name(scene[id].name);
    std::size_t place = first_kind + kind;
    for (std::size_t i = objects.size(); i-- > 0;) {
      auto const& wanted = objects[i].surfaces;
      if (!same_name(wanted, kind_name(kind)) && !matches(wanted, name)) continue;
      place = places[i];
      used[i] = true;
    }
    made.group_of.push_back(place);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    bool const is_kind = [&] {
      for (std::size_t kind = 0; kind < shade_kinds; ++kind) {
        if (same_name(objects[i].surfaces, kind_name(kind))) return true;
      }
      return false;
    }();
    if (used[i] || is_kind) continue;
    throw Error(fmt::format("{}: {} is {}: no surface of the model matches", objects[i].where,
                            extension::surrounding_group::surface_name.title,
                            in_quotes(objects[i].surfaces)));
  }
  return made;
}

// Exterior surfaces of zones.
std::vector<SurfaceId> exchanging_surfaces(SceneAssembly const& scene) {
  auto ids = scene.receivers();
  std::erase_if(ids, [&](SurfaceId id) {
    auto const& name = scene.surfaces()[id].name;
    return scene.model().shading.shading_surfaces.contains(name) || is_mirrored(name) ||
           scene.model().own_environments.contains(name);
  });
  return ids;
}

// EnergyPlus's own ratio of sky diffuse radiation, from the centres of its patches.
std::vector<double> sky_ratios(SceneAssembly& scene, std::vector<SurfaceId> const& receivers,
                               Messages const& messages) {
  auto const sky = energyplus_sky();
  std::vector<SunDirection> directions;
  for (auto const& patch : sky.patches) directions.push_back(patch.centre);
  auto answers = open_for_task(scene, receivers, messages);
  auto const areas = scene.areas();
  auto const& factors = scene.optics().factors();
  auto const rendered = answers.at(directions, receivers);
  std::vector<double> ratios;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    auto const& area = areas[receivers[k]];
    double whole = 0.0;
    double seen = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      auto const towards = to_vector(directions[i]);
      double const cosine = glm::dot(glm::normalize(area), towards);
      if (cosine < min_cosine) continue;
      double const weight = cosine * sky.patches[i].solid_angle;
      whole += weight;
      seen += weight * sunlit_fraction(rendered[i][k].at(factors), area, towards);
    }
    ratios.push_back(whole > 0.0 ? seen / whole : 1.0);
  }
  return ratios;
}

void write_table(std::vector<ViewedGroup> const& groups, std::vector<SurfaceViews> const& views,
                 std::vector<double> const& errors, std::ostream& csv) {
  std::vector<std::size_t> seen;  // with sky and ground
  for (std::size_t k = 0; k < groups.size(); ++k) {
    auto const sees = [&](SurfaceViews const& one) { return one.millionths[k] > 0; };
    if (k < viewed_surfaces || std::any_of(views.begin(), views.end(), sees)) seen.push_back(k);
  }
  csv << "surface";
  for (auto const k : seen) csv << ',' << csv_field(groups[k].name);
  csv << ",standard error\n";
  for (std::size_t i = 0; i < views.size(); ++i) {
    csv << csv_field(views[i].surface);
    for (auto const k : seen) csv << fmt::format(",{:.6f}", views[i].millionths[k] / 1e6);
    csv << fmt::format(",{:.2g}\n", errors[i]);
  }
}

}  // namespace

std::string perform(SurroundingsTask const& task, SceneAssembly& scene, Messages const& messages) {
  auto const receivers = exchanging_surfaces(scene);
  auto const ratios = sky_ratios(scene, receivers, messages);
  auto const surfaces = scene.scene(ShadeOptics::Radiation::long_wave);
  RayScene const rays(surfaces, {.screens = ScreenDetail::automatic});
  auto const grouping = group(scene, surfaces);
  auto const& groups = grouping.groups;
  Progress progress("tracing rays to the surroundings", receivers.size(), task.progress);
  std::vector<SurfaceViews> views;
  std::vector<double> errors;
  for (auto const id : receivers) {
    RayConditions const conditions{.receiver = id,
                                   .factors = scene.optics().factors(),
                                   .deployments = scene.optics().deployments()};
    constexpr int cells = 256;
    auto const found =
        trace_view_factors(rays, conditions, grouping.group_of, groups.size(),
                           points_of(scene.surfaces()[id].polygon, cells), task.rays);
    views.push_back(
        {scene.surfaces()[id].name, in_millionths(found.factors), ratios[views.size()]});
    errors.push_back(found.error);
    progress.at(views.size());
  }
  auto const editor = is_epjson(task.file) ? edit_epjson(nlohmann::json::object()) : edit_idf("");
  auto const cut_off = add_local_environments(*editor, groups, views);
  if (!cut_off.empty()) {
    messages.warning(fmt::format(
        "EnergyPlus limits given view factors to a sum of 1, so that these surfaces exchange less "
        "with the sky than they see of it: {}",
        listed(cut_off, 3)));
  }
  if (auto const& shades = scene.model().moving_shades; !shades.empty()) {
    messages.warning(
        fmt::format("{}: view factors for long-wave exchange are those of the position at rest",
                    shades.front().where));
  }
  write_whole_file(task.file, [&](std::ostream& out) { out << editor->text(); });
  if (!task.table.empty()) {
    write_whole_file(task.table,
                     [&](std::ostream& out) { write_table(groups, views, errors, out); });
  }
  auto const worst = errors.empty() ? 0.0 : *std::max_element(errors.begin(), errors.end());
  return fmt::format("view factors of {} surfaces, largest standard error {:.1g}", views.size(),
                     worst);
}

}  // namespace gpu_shading::energyplus
