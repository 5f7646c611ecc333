#include "session/shade_optics.h"

#include <fmt/format.h>

#include "gpu_shading/transmittance.h"

namespace gpu_shading::energyplus {

ShadeOptics::ShadeOptics(Model const& model, Schedules schedules)
    : model_(&model), schedules_(std::move(schedules)) {
  for (auto const& [name, surface] : model.shading.shading_surfaces) {
    auto const& schedule_name = surface.transmittance_schedule;
    if (schedule_name.empty()) continue;
    auto const [place, added] = by_name_.try_emplace(schedule_name);
    if (!added) continue;
    auto const [least, most] = schedules_.range(schedule_name);
    if (least == most) {
      place->second.held = least;
    } else {
      make_factor(schedule_name, place->second);
    }
  }
}

void ShadeOptics::make_factor(std::string const& name, Schedule& schedule) {
  schedule.held.reset();
  schedule.factor = static_cast<int>(factor_names_.size());
  factor_names_.push_back(name);
  factors_.push_back(0.0);
}

void ShadeOptics::apply(Surface& surface) const {
  auto const shading = model_->shading.shading_surfaces.find(surface.name);
  if (shading == model_->shading.shading_surfaces.end()) return;
  auto const shade = model_->shades.by_surface.find(surface.name);
  if (shade != model_->shades.by_surface.end()) {
    surface.transmittance = shade->second.transmittance;
  }
  auto const schedule = by_name_.find(shading->second.transmittance_schedule);
  if (schedule == by_name_.end()) return;
  auto const& held = schedule->second.held;
  if (!held) {
    surface.schedule = schedule->second.factor;
  } else if (*held <= 0.0) {
    surface.transmittance.reset();
  } else if (*held < 1.0) {
    Transmittance const model =
        surface.transmittance ? *surface.transmittance : Transmittance::constant(1.0);
    surface.transmittance =
        std::make_shared<Transmittance const>(Transmittance::product(model, *held));
  } else if (!surface.transmittance) {
    surface.casting = Casting::never;
  }
}

bool ShadeOptics::update(Moment moment) {
  bool changed = false;
  for (auto& [name, schedule] : by_name_) {
    if (schedule.held && schedules_.value(name, moment) != *schedule.held) {
      make_factor(name, schedule);
      changed = true;
    }
  }
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    factors_[i] = schedules_.value(factor_names_[i], moment);
  }
  return changed;
}

std::string describe_optics(Model const& model, std::string const& surface) {
  auto const shading = model.shading.shading_surfaces.find(surface);
  if (shading == model.shading.shading_surfaces.end()) return "opaque";
  auto const shade = model.shades.by_surface.find(surface);
  auto const& schedule = shading->second.transmittance_schedule;
  std::string text;
  if (shade != model.shades.by_surface.end()) {
    text = fmt::format("transparent ({})", shade->second.description);
  }
  if (!schedule.empty()) {
    text += fmt::format("{}schedule {}", text.empty() ? "" : " x ", schedule);
  }
  return text.empty() ? "opaque" : text;
}

}  // namespace gpu_shading::energyplus
