#include "scene/scene_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "gpu_shading/error.h"
#include "model/extensions/extension_fields.h"
#include "model/geometry_rules.h"
#include "model/site/farthest_coordinate.h"
#include "platform/text.h"
#include "scene/digest.h"
#include "scene/model_rule.h"
#include "scene/scene_hash.h"
#include "scene/shade_motion.h"

namespace gpu_shading::energyplus {

namespace {

// EnergyPlus hands over what it has read.
void check_coordinates(Surface const& surface, std::string const& model) {
  auto const check = [&](Ring const& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      auto const& point = ring[i];
      if (is_within_reach(point)) continue;
      throw Error(fmt::format("{}: surface {}: vertex {} {}", model, printable(surface.name), i + 1,
                              describe_out_of_reach(point)));
    }
  };
  check(surface.polygon.outline);
  for (auto const& hole : surface.polygon.holes) check(hole);
}

}  // namespace

SurfaceId SceneAssembly::add(Surface surface) {
  if (surface.casting != Casting::never) surface.casting = model_.shading.casting(surface.name);
  double const farthest = largest_coordinate(surface.polygon);
  if (farthest >= single_precision_reach && !model_.far_outlines.restore(surface)) {
    rounded_.push_back(surface.name);
    farthest_rounded_ = std::max(farthest_rounded_, farthest);
  }
  double ratio = 1.0;
  auto const written = model_.simplified.outlines.find(surface.name);
  if (written != model_.simplified.outlines.end()) {
    double const passed = area(surface.polygon);
    surface.polygon.outline = written->second;
    double const rendered = area(surface.polygon);
    if (rendered > 0.0) ratio = passed / rendered;
  }
  check_coordinates(surface, model_.file);
  area_ratios_.push_back(ratio);
  return surfaces_.add(std::move(surface));
}

std::string SceneAssembly::warn_of_rounding() const {
  constexpr double negligible = 1e-3;
  double const error = single_precision_error(farthest_rounded_);
  if (error < negligible) return {};
  return fmt::format(
      "EnergyPlus passes vertices in single precision, which moves those of {} surface{} by up to "
      "{:.1g} m, {:.0f} m from the origin: {}; move the model to the origin",
      rounded_.size(), rounded_.size() == 1 ? "" : "s", error, farthest_rounded_,
      listed(rounded_, 3));
}

SurfaceId SceneAssembly::add_mirrored(SurfaceId original) {
  area_ratios_.push_back(area_ratios_[original]);
  return surfaces_.add(mirrored(surfaces_[original]));
}

void SceneAssembly::complete(Schedules schedules) {
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    auto const& name = surfaces_[id].name;
    bool const wanted = model_.shading.receives(name) && !window_of_reveal(name);
    receives_.push_back(wanted);
    bool const shading = model_.shading.shading_surfaces.contains(name) || is_mirrored(name);
    unshaded_.push_back(!wanted && shading);
  }
  complete_ = true;
  for (auto& caster : model_.lean.casters) {
    check_coordinates(caster, model_.file);
    surfaces_.add(std::move(caster));
  }
  model_.lean.casters.clear();
  model_.surroundings.first = static_cast<SurfaceId>(surfaces_.size());
  for (auto& caster : model_.surroundings.casters) {
    check_coordinates(caster.surface, model_.file);
    surfaces_.add(std::move(caster.surface));
  }
  set_schedules(std::move(schedules));
  find_moving_shades();
}

void SceneAssembly::find_moving_shades() {
  auto const& shades = model_.moving_shades;
  if (shades.empty()) return;
  std::map<std::string, std::size_t> by_name;
  for (std::size_t i = 0; i < shades.size(); ++i) {
    for (auto const& name : shades[i].surfaces) {
      by_name.emplace(name, i);
      by_name.emplace(mirrored_name(name), i);
    }
  }
  positions_ = rest_positions();
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    auto const found = by_name.find(surfaces_[id].name);
    moving_shades_.push_back(found == by_name.end() ? std::nullopt : std::optional(found->second));
  }
  std::vector<std::vector<Surface>> drawn(shades.size());
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    auto const& surface = surfaces_[id];
    bool const counts =
        moving_shades_[id] && !is_mirrored(surface.name) && area(surface.polygon) > 0;
    if (counts) drawn[*moving_shades_[id]].push_back(surface);
  }
  for (std::size_t i = 0; i < shades.size(); ++i) {
    bool const tracks = shades[i].control == MovingShade::Control::track_sun;
    if (tracks && !drawn[i].empty()) expect_parallel(drawn[i], shades[i]);
    if (!shades[i].folds()) continue;
    std::vector<Polygon> panels;
    for (auto const& surface : drawn[i]) panels.push_back(surface.polygon);
    model_.moving_shades[i].track = fold_track(panels, shades[i]);
  }
}

std::vector<double> SceneAssembly::rest_positions() const {
  std::vector<double> positions;
  for (auto const& shade : model_.moving_shades) positions.push_back(shade.rest);
  return positions;
}

bool SceneAssembly::hides_moving_shades() const {
  for (auto id = size(); id < moving_shades_.size(); ++id) {
    if (moving_shades_[id]) return true;
  }
  return false;
}

PointMotion SceneAssembly::motion_of(SurfaceId id, std::vector<double> const& positions) const {
  auto const shade = moving_shade_of(id);
  if (!shade) return [](glm::dvec3 const& point) { return point; };
  return energyplus::motion_of(surfaces_[id].polygon, model_.moving_shades[*shade],
                               positions.at(*shade));
}

Surface SceneAssembly::placed(SurfaceId id, std::vector<double> const& positions) const {
  auto surface = surfaces_[id];
  if (auto const shade = moving_shade_of(id)) {
    surface.polygon = moved(surface.polygon, model_.moving_shades[*shade], positions.at(*shade));
    if (area(surface.polygon) <= 0.0) surface.casting = Casting::never;
  }
  return surface;
}

std::optional<TextureAxes> SceneAssembly::texture_of(SurfaceId id,
                                                     std::vector<double> const& positions) const {
  auto const drawn = model_.surroundings.texture_of(id);
  auto const shade = moving_shade_of(id);
  if (!drawn || !shade) return drawn;
  return moved(*drawn, model_.moving_shades[*shade], positions.at(*shade));
}

std::vector<SurfaceId> SceneAssembly::shading_surfaces() const {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    if (model_.shading.shading_surfaces.contains(surfaces_[id].name)) ids.push_back(id);
  }
  return ids;
}

std::vector<glm::dvec3> SceneAssembly::areas() const {
  std::vector<glm::dvec3> areas;
  areas.reserve(size());
  for (SurfaceId id = 0; id < size(); ++id) {
    auto const& polygon = surfaces_[id].polygon;
    areas.push_back(area(polygon) * normal(polygon));
  }
  return areas;
}

std::vector<SurfaceId> SceneAssembly::receivers() const {
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < size(); ++id) {
    if (receives_[id] && area(surfaces_[id].polygon) > 0.0) ids.push_back(id);
  }
  return ids;
}

std::vector<SurfaceId> SceneAssembly::shown_receivers() const {
  auto const& shading = model_.shading;
  auto ids = receivers();
  std::erase_if(ids, [&](SurfaceId id) {
    auto const& name = surfaces_[id].name;
    return (shading.shading_surfaces.contains(name) || is_mirrored(name)) && !shading.names(name);
  });
  return ids;
}

std::vector<SurfaceId> SceneAssembly::shown() const {
  auto const& types = model_.surroundings.types;
  std::vector<SurfaceId> ids;
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    auto const& name = surfaces_[id].name;
    auto const type = types.find(name);
    bool const context = type != types.end() && type->second == extension::site_context::type;
    bool const copy = is_mirrored(name) && !model_.shading.names(name);
    if (!context && !copy) ids.push_back(id);
  }
  return ids;
}

Scene SceneAssembly::scene_at(std::vector<double> const& positions,
                              ShadeOptics::Radiation radiation,
                              std::optional<std::size_t> opaque) const {
  Scene scene;
  for (SurfaceId id = 0; id < surfaces_.size(); ++id) {
    auto surface = placed(id, positions);
    optics_.apply(surface, texture_of(id, positions), radiation);
    if (opaque && moving_shade_of(id) == opaque) surface.filter = {};
    scene.add(std::move(surface));
  }
  std::vector<WallCopy> copies;
  for (SurfaceId id = 0; id < size(); ++id) {
    auto const& wall = surfaces_[id];
    if (wall.polygon.holes.empty() || wall.casting == Casting::never) continue;
    Surface closed;
    closed.name = wall.name;
    closed.polygon.outline = wall.polygon.outline;
    closed.casting = wall.casting;
    optics_.apply(closed, std::nullopt, radiation);
    copies.push_back({id, scene.add(std::move(closed))});
  }
  scene.set_rule(make_shading_rule(model_.shading, scene, copies).rule);
  return scene;
}

Scene SceneAssembly::hidden_casters() const {
  Scene scene;
  for (auto id = static_cast<SurfaceId>(size()); id < surfaces_.size(); ++id) {
    auto surface = placed(id, positions_);
    optics_.apply(surface, texture_of(id, positions_), ShadeOptics::Radiation::light);
    if (surface.casting != Casting::never) scene.add(std::move(surface));
  }
  return scene;
}

Hash SceneAssembly::hash(Scene const& scene, DeviceInfo const& device) const {
  auto const at_rest = hash_scene(scene, {renderer_options(model_.options), device, build_id()});
  if (moving_shades_.empty()) return at_rest;
  // Three positions tell one motion from another.
  Digest digest;
  digest.add(at_rest);
  for (SurfaceId id = 0; id < moving_shades_.size(); ++id) {
    if (!moving_shades_[id]) continue;
    digest.add(id);
    auto const& shade = model_.moving_shades[*moving_shades_[id]];
    for (double const position :
         {shade.minimum, 0.5 * (shade.minimum + shade.maximum), shade.maximum}) {
      for (auto const& point : moved(surfaces_[id].polygon, shade, position).outline) {
        for (double const coordinate : {point.x, point.y, point.z}) digest.add(coordinate);
      }
    }
  }
  return digest.result();
}

Surface mirrored(Surface const& original) {
  Surface copy;
  copy.name = mirrored_name(original.name);
  copy.polygon = original.polygon;
  copy.casting = Casting::never;
  std::reverse(copy.polygon.outline.begin(), copy.polygon.outline.end());
  return copy;
}

RendererOptions renderer_options(Options const& options) {
  RendererOptions chosen;
  chosen.device = options.device;
  chosen.resolution = options.resolution;
  chosen.error = options.error;
  return chosen;
}

std::string describe_fineness(Options const& options) {
  return options.resolution
             ? fmt::format("{} x {} pixels", *options.resolution, *options.resolution)
             : fmt::format("error {}", options.error);
}

}  // namespace gpu_shading::energyplus
