#include "scene/shade_optics.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu_shading/transmittance.h"
#include "model/extensions/extension_fields.h"
#include "platform/naming.h"

namespace gpu_shading::energyplus {
namespace {

// The screen of a surface, nullptr if it has none. A surface without area cannot have one.
SurfaceScreen const* screen_of(Model const& model, Surface const& surface) {
  auto const found = model.screens.by_surface.find(surface.name);
  if (found == model.screens.by_surface.end() || area(surface.polygon) <= 0.0) return nullptr;
  return &found->second;
}

}  // namespace

ShadeOptics::ShadeOptics(Model const& model, Schedules schedules)
    : model_(&model), schedules_(std::move(schedules)) {
  add_transmittance_schedules();
  add_deployments();
  add_leaf_schedules();
}

std::pair<double, double> ShadeOptics::range_for(std::string const& name, std::string const& object,
                                                 std::string_view field) {
  auto const place = fields_.try_emplace(name, fmt::format("{}: {}", object, field)).first;
  return naming(place->second, [&] { return schedules_.range(name); });
}

double ShadeOptics::value(std::string const& name, Moment moment) const {
  return naming(fields_.at(name), [&] { return schedules_.value(name, moment); });
}

void ShadeOptics::add_transmittance_schedules() {
  for (auto const& [name, surface] : model_->shading.shading_surfaces) {
    auto const& schedule_name = surface.transmittance_schedule;
    if (schedule_name.empty()) continue;
    auto const [place, added] = by_name_.try_emplace(schedule_name);
    if (!added) continue;
    auto const [least, most] =
        range_for(schedule_name, surface.type + " " + name, "Transmittance Schedule Name");
    if (least == most) {
      place->second.held = least;
    } else {
      make_factor(schedule_name, place->second);
    }
  }
}

void ShadeOptics::add_deployments() {
  for (auto const& [surface, screen] : model_->screens.by_surface) {
    auto const& name = screen.deployment_schedule;
    auto const& known = deployment_names_;
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    auto const range = range_for(name, screen.maker->where(),
                                 extension::perforated_screen::deployment_schedule_name.title);
    add_deployment(name, range.second);
  }
}

void ShadeOptics::add_leaf_schedules() {
  for (auto const& name : model_->surroundings.leaf_schedules) {
    auto const range = range_for(name, std::string(extension::tree::type),
                                 extension::tree::leaf_schedule_name.title);
    add_deployment(name, range.second);
  }
}

void ShadeOptics::add_deployment(std::string const& name, double most) {
  auto const& known = deployment_names_;
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  deployment_names_.push_back(name);
  deployments_.push_back(most);
}

int ShadeOptics::deployment_of(std::string const& schedule) const {
  auto const& known = deployment_names_;
  auto const found = std::find(known.begin(), known.end(), schedule);
  return found == known.end() ? -1 : static_cast<int>(found - known.begin());
}

void ShadeOptics::make_factor(std::string const& name, Schedule& schedule) {
  schedule.held.reset();
  schedule.factor = static_cast<int>(factor_names_.size());
  factor_names_.push_back(name);
  factors_.push_back(0.0);
}

void ShadeOptics::apply(Surface& surface, std::optional<TextureAxes> const& texture,
                        Radiation radiation) const {
  if (auto const* const crown = surface.filter.find<Crown>()) {
    Crown leaved = *crown;
    if (leaved.deployment >= 0) {
      auto const place = static_cast<std::size_t>(leaved.deployment);
      leaved.deployment = deployment_of(model_->surroundings.leaf_schedules[place]);
    }
    surface.filter.set(leaved);
    return;
  }
  auto const shading = model_->shading.shading_surfaces.find(surface.name);
  if (shading == model_->shading.shading_surfaces.end()) return;
  auto const shade = model_->shades.by_surface.find(surface.name);
  if (shade != model_->shades.by_surface.end()) {
    if (radiation == Radiation::long_wave && shade->second.glass) return;
    surface.filter.set(radiation == Radiation::light ? shade->second.visible : shade->second.solar);
  }
  apply_screen(surface, texture);
  auto const schedule = by_name_.find(shading->second.transmittance_schedule);
  if (schedule == by_name_.end()) return;
  auto const& held = schedule->second.held;
  if (!held) {
    surface.filter.schedule = schedule->second.factor;
  } else if (*held <= 0.0) {
    surface.filter = {};
  } else if (*held < 1.0) {
    auto const* const dimmed = surface.filter.find<AngularTransmittance>();
    auto const* const model = dimmed != nullptr ? dimmed->model.get() : nullptr;
    auto& product = products_[{model, *held}];
    if (!product) {
      product = std::make_shared<Transmittance const>(
          Transmittance::product(model != nullptr ? *model : Transmittance::constant(1.0), *held));
    }
    surface.filter.set(AngularTransmittance{product});
  } else if (!surface.filter.transmits()) {
    surface.casting = Casting::never;
  }
}

void ShadeOptics::apply_screen(Surface& surface, std::optional<TextureAxes> const& texture) const {
  auto const* const screen = screen_of(*model_, surface);
  if (screen == nullptr) return;
  PerforatedSheet sheet{screen->maker->make(surface.polygon, texture),
                        screen->maker->placement(surface.polygon, texture)};
  sheet.deployment = deployment_of(screen->deployment_schedule);
  surface.filter.set(std::move(sheet));
}

bool ShadeOptics::update(Moment moment) {
  bool changed = false;
  for (auto& [name, schedule] : by_name_) {
    if (schedule.held && value(name, moment) != *schedule.held) {
      make_factor(name, schedule);
      changed = true;
    }
  }
  factors_ = factors_at(moment);
  deployments_ = deployments_at(moment);
  return changed;
}

std::vector<double> ShadeOptics::factors_at(Moment moment) const {
  std::vector<double> factors;
  for (auto const& name : factor_names_) factors.push_back(value(name, moment));
  return factors;
}

std::vector<double> ShadeOptics::deployments_at(Moment moment) const {
  std::vector<double> deployments;
  for (auto const& name : deployment_names_) {
    deployments.push_back(moment.timestep > 0 ? value(name, moment)
                                              : schedules_.range(name).second);
  }
  return deployments;
}

std::string describe_optics(Model const& model, Surface const& surface,
                            std::optional<TextureAxes> const& texture) {
  if (auto const* const crown = surface.filter.find<Crown>()) {
    auto text = fmt::format("crown, {:.1f} m high, leaf area density {:.3g}, wood {:.3g} m2/m3",
                            crown->height, crown->leaf_density, crown->wood_density);
    if (crown->deployment < 0) return text;
    auto const place = static_cast<std::size_t>(crown->deployment);
    return text + fmt::format(", leaves by {}", model.surroundings.leaf_schedules[place]);
  }
  auto const shading = model.shading.shading_surfaces.find(surface.name);
  if (shading == model.shading.shading_surfaces.end()) return "opaque";
  auto const shade = model.shades.by_surface.find(surface.name);
  auto const& schedule = shading->second.transmittance_schedule;
  std::string text;
  if (shade != model.shades.by_surface.end()) {
    text = shade->second.description;
  }
  if (auto const* const screen = screen_of(model, surface)) {
    text = screen->maker->describe(surface.polygon, texture);
    if (!screen->deployment_schedule.empty()) {
      text += fmt::format(" deployed by {}", screen->deployment_schedule);
    }
  }
  if (!schedule.empty()) {
    text += fmt::format("{}schedule {}", text.empty() ? "" : " x ", schedule);
  }
  return text.empty() ? "opaque" : text;
}

}  // namespace gpu_shading::energyplus
