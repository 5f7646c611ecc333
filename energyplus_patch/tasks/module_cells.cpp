#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/cached_renderer.h"
#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "platform/progress.h"
#include "reports/map_grid.h"
#include "reports/module_layout.h"
#include "reports/remarks.h"
#include "reports/sky_mask.h"
#include "runs/run_times.h"
#include "tasks/perform_task.h"
#include "tasks/run_conditions.h"

namespace gpu_shading::energyplus {
namespace {

// Cells times times: 8 GB of answers.
constexpr std::size_t max_values = 4'000'000'000;

// A rectangle of a field: the field, a module, or a cell. Its parts, if any, are [first, first +
// parts) of all rectangles, its cells [first_cell, first_cell + cells) of the field.
struct Piece {
  double area = 0.0;
  std::size_t first = 0;
  std::size_t parts = 0;
  std::size_t first_cell = 0;
  std::size_t cells = 1;
};

// The field first, then its modules, then their cells.
std::vector<Piece> pieces_of(ModuleLayout const& layout, PointMotion const& move,
                             std::vector<Polygon>& polygons) {
  auto const modules = layout.modules().size();
  auto const cells = layout.spec().cells();
  std::vector<Piece> pieces;
  auto const add = [&](FlatBox const& box, Piece piece) {
    auto& polygon = polygons.emplace_back(layout.polygon(box));
    std::ranges::transform(polygon.outline, polygon.outline.begin(), move);
    piece.area = area(polygons.back());
    pieces.push_back(piece);
  };
  add(layout.bounds(), {0.0, 1, modules, 0, modules * cells});
  for (std::size_t i = 0; i < modules; ++i) {
    add(layout.modules()[i].box, {0.0, 1 + modules + i * cells, cells, i * cells, cells});
  }
  for (auto const& module : layout.modules()) {
    for (std::size_t k = 0; k < cells; ++k) {
      add(layout.cell(module, k), {0.0, 0, 0, pieces.size() - 1 - modules, 1});
    }
  }
  return pieces;
}

// The scene with the pieces of a surface as receivers, by its own rule. The surface itself, which
// may not be quite flat, does not shade them.
Scene scene_with(Scene const& scene, SurfaceId surface, std::vector<Polygon> const& polygons) {
  Scene whole;
  for (SurfaceId id = 0; id < scene.size(); ++id) whole.add(scene[id]);
  for (auto const& polygon : polygons) whole.add({"", polygon, Casting::never, {}});
  auto rule = scene.rule();
  if (rule.empty()) {
    rule.zones = 1;
    rule.zone_shades = {1};
    for (SurfaceId id = 0; id < scene.size(); ++id) rule.roles.push_back({.wall = id});
  }
  auto const own = rule.roles[surface];
  rule.roles[surface].shades = ShadingRule::Shades::one_surface;
  rule.roles[surface].target = surface;
  rule.roles.resize(whole.size(), {.wall = own.wall, .zone = own.zone});
  whole.set_rule(std::move(rule));
  return whole;
}

// Sunlit fractions of the cells of one field. A piece that is lit, or shaded, as a whole stands for
// all of its parts; of others, the parts are asked about.
class CellLight {
 public:
  // `positions`: of the moving shades.
  CellLight(SceneAssembly const& scene, SurfaceId surface, ModuleLayout const& layout,
            std::vector<double> const& positions, RendererOptions const& options)
      : normal_(layout.axes().normal) {
    std::vector<Polygon> polygons;
    pieces_ = pieces_of(layout, scene.motion_of(surface, positions), polygons);
    auto const casters = scene.scene_at(positions);
    first_ = static_cast<SurfaceId>(casters.size());
    renderer_.emplace(scene_with(casters, surface, polygons), options);
  }

  DeviceInfo const& device() const { return renderer_->device(); }

  void at(SunDirection sun, std::vector<double> const& factors,
          std::vector<double> const& deployments, std::vector<float>& fractions) {
    fractions.assign(pieces_.front().cells, 0.0F);
    double const cosine = glm::dot(to_vector(sun), normal_);
    if (cosine < min_cosine) return;
    renderer_->set_deployments(deployments);
    std::vector<std::size_t> asked{0};
    while (!asked.empty()) {
      std::vector<SurfaceId> ids;
      ids.reserve(asked.size());
      for (auto const i : asked) ids.push_back(first_ + static_cast<SurfaceId>(i));
      auto const answers = renderer_->projected_sunlit_areas(sun, ids);
      std::vector<std::size_t> next;
      for (std::size_t i = 0; i < asked.size(); ++i) {
        auto const& piece = pieces_[asked[i]];
        double const lit = std::clamp(answers[i].at(factors) / (piece.area * cosine), 0.0, 1.0);
        constexpr double rounding = 1e-6;
        if (piece.parts > 0 && lit > rounding && lit < 1.0 - rounding) {
          for (std::size_t k = 0; k < piece.parts; ++k) next.push_back(piece.first + k);
        } else {
          std::fill_n(fractions.begin() + static_cast<std::ptrdiff_t>(piece.first_cell),
                      piece.cells, static_cast<float>(lit));
        }
      }
      asked = std::move(next);
    }
  }

 private:
  glm::dvec3 normal_;
  std::vector<Piece> pieces_;
  SurfaceId first_ = 0;
  std::optional<Renderer> renderer_;
};

struct LaidField {
  SurfaceId surface;
  ModuleLayout layout;
};

std::vector<LaidField> lay_out(SceneAssembly const& scene, std::size_t times) {
  auto const& all = scene.model().pv_modules;
  if (all.empty()) {
    throw Error(fmt::format("{}: has no {}", scene.model().file, extension::pvmodules::type));
  }
  std::vector<LaidField> fields;
  std::size_t cells = 0;
  for (auto const& modules : all) {
    for (auto const& name : modules.surfaces) {
      std::optional<SurfaceId> found;
      for (SurfaceId id = 0; id < scene.surfaces().size() && !found; ++id) {
        if (scene.surfaces()[id].name == name) found = id;
      }
      if (!found || area(scene.surfaces()[*found].polygon) <= 0.0) {
        throw Error(fmt::format("{}: {} has no area", modules.where, name));
      }
      if (auto const shade = scene.moving_shade_of(*found)) {
        auto const& moving = scene.model().moving_shades[*shade];
        if (moving.motion != MovingShade::Motion::slide) {
          throw Error(fmt::format("{}: {} is turned or extended by {}; expected one that slides",
                                  modules.where, name, moving.where));
        }
      }
      fields.push_back({*found, ModuleLayout(modules, name, scene.surfaces()[*found].polygon)});
      cells += fields.back().layout.modules().size() * modules.cells();
    }
  }
  if (cells * times > max_values) {
    throw Error(
        fmt::format("--from: {} cells at {} times, expected at most {} values: choose "
                    "fewer days",
                    cells, times, max_values));
  }
  return fields;
}

// Strings do not continue on the next surface.
void warn_of_short_strings(std::vector<LaidField> const& fields, Messages const& messages) {
  auto const rest = [](ModuleLayout const& layout) {
    auto const length = layout.spec().string_length;
    return length ? layout.modules().size() % static_cast<std::size_t>(*length) : 0;
  };
  auto const is_short = [&](LaidField const& field) { return rest(field.layout) != 0; };
  auto const first = std::ranges::find_if(fields, is_short);
  if (first == fields.end()) return;
  auto const others = std::ranges::count_if(fields, is_short) - 1;
  auto const& layout = first->layout;
  messages.warning(
      fmt::format("{}: strings end with their surface: the last one on {} has {} of {} modules{}",
                  layout.spec().where, layout.surface(), rest(layout), *layout.spec().string_length,
                  others > 0 ? fmt::format(", and {} more are short", others) : ""));
}

// View factor of each module to the sky.
std::vector<ModuleSky> sky_of(LaidField const& field, RayScene const& rays,
                              std::vector<ShadeKind> const& kinds, SceneAssembly& scene) {
  constexpr int step = 6;  // degrees
  constexpr int points = 6;
  SkyGrid const grid(step);
  RayConditions const conditions{.receiver = field.surface,
                                 .factors = scene.optics().factors(),
                                 .deployments = scene.optics().deployments()};
  std::vector<ModuleSky> views;
  for (auto const& module : field.layout.modules()) {
    auto const polygon = field.layout.polygon(module.box);
    auto const shares =
        trace_shares(rays, conditions, kinds, points_of(polygon, points), grid.directions());
    auto const view = sky_view(grid, shares, field.layout.axes().normal);
    views.push_back({view.view, view.unshaded});
  }
  return views;
}

// At rest, with schedules at their lowest value and screens fully deployed.
std::vector<std::vector<ModuleSky>> skies_of(std::vector<LaidField> const& fields,
                                             SceneAssembly& scene) {
  scene.optics().update({});
  auto const casters = scene.scene();
  RayScene const rays(casters, {.screens = ScreenDetail::automatic});
  auto const kinds = kinds_of(scene, casters);
  std::vector<std::vector<ModuleSky>> skies;
  skies.reserve(fields.size());
  for (auto const& field : fields) skies.push_back(sky_of(field, rays, kinds, scene));
  return skies;
}

std::array<char, 2> little_endian(float fraction) {
  constexpr float whole = 65535.0F;
  constexpr unsigned byte = 8;
  auto const value = static_cast<std::uint16_t>(std::lround(fraction * whole));
  return {static_cast<char>(value & 0xFFU), static_cast<char>(value >> byte)};
}

// The numbers of times, by the nearest positions of the moving shades.
std::map<std::vector<double>, std::vector<std::size_t>> times_by_positions(
    std::vector<ShadeConditions> const& conditions) {
  std::map<std::vector<double>, std::vector<std::size_t>> by_positions;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    by_positions[conditions[i].positions.front().positions].push_back(i);
  }
  return by_positions;
}

std::string bytes_of(std::vector<float> const& fractions) {
  std::string row;
  row.reserve(2 * fractions.size());
  for (float const fraction : fractions) {
    auto const bytes = little_endian(fraction);
    row.append(bytes.data(), bytes.size());
  }
  return row;
}

}  // namespace

std::string perform(ModulesTask const& task, SceneAssembly& scene, Messages const& messages) {
  describe_scene(scene, messages);
  auto const& times = task.run.times;
  auto const fields = lay_out(scene, times.size());
  warn_of_short_strings(fields, messages);
  auto const options = watched_options(scene.model().options, messages);
  auto const skies = skies_of(fields, scene);
  auto const conditions = read_conditions(task.run, scene);
  auto const by_positions = times_by_positions(conditions);
  Progress progress("shading cells", fields.size() * times.size(), task.progress);
  std::vector<ModuleField> results;
  std::size_t modules = 0;
  std::size_t cells = 0;
  std::size_t done = 0;
  bool checked = false;
  for (auto const& field : fields) {
    auto const& layout = field.layout;
    auto const file = task.folder / std::to_string(results.size());
    std::ofstream out(file, std::ios::binary);
    std::vector<float> fractions;
    for (auto const& [positions, numbers] : by_positions) {
      CellLight light(scene, field.surface, layout, positions, options);
      if (!std::exchange(checked, true)) {
        check_device(light.device(), scene.model().options, messages);
      }
      for (auto const i : numbers) {
        light.at(times[i].sun, conditions[i].factors, conditions[i].deployments, fractions);
        auto const row = bytes_of(fractions);
        out.seekp(static_cast<std::streamoff>(i * row.size()));
        out.write(row.data(), static_cast<std::streamsize>(row.size()));
        progress.at(++done);
      }
    }
    if (!out.flush()) throw Error(fmt::format("{}: cannot be written", file.string()));
    auto const& sky = skies[results.size()];
    results.push_back(
        {layout.spec().name, layout.surface(), scene.surfaces()[field.surface].polygon, sky});
    modules += layout.modules().size();
    cells += layout.modules().size() * layout.spec().cells();
  }
  write_module_fields(task.file, results);
  return fmt::format("{} modules with {} cells on {} surfaces, {} times with the sun up", modules,
                     cells, fields.size(), times.size());
}

}  // namespace gpu_shading::energyplus
