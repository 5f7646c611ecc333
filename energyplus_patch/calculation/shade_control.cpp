#include "calculation/shade_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "gpu_shading/error.h"
#include "platform/naming.h"
#include "platform/text.h"
#include "scene/flat_polygon.h"
#include "scene/shade_motion.h"

namespace gpu_shading::energyplus {
namespace {

using Control = MovingShade::Control;

constexpr std::size_t points_of_receiver = 256;
constexpr std::size_t max_trials = 200;
// Sunlit fraction below which a receiver counts as shaded: EnergyPlus takes such as 0.
constexpr double no_beam = 1e-5;
constexpr double half_circle = 180.0;

std::vector<double> from_rest(MovingShade const& shade) {
  auto all = shade.positions();
  std::stable_sort(all.begin(), all.end(), [&](double a, double b) {
    return std::abs(a - shade.rest) < std::abs(b - shade.rest);
  });
  return all;
}

}  // namespace

ShadeControl::ShadeControl(SceneAssembly const& scene) : scene_(scene) {
  check_schedules();
  auto const& shades = scene.model().moving_shades;
  auto const areas = scene.areas();
  for (std::size_t i = 0; i < shades.size(); ++i) {
    Shade shade{shades[i], from_rest(shades[i]), {}};
    std::vector<std::string> names;
    for (auto const id : scene.receivers()) {
      if (scene.moving_shade_of(id)) continue;
      auto const& surface = scene.surfaces()[id];
      names.push_back(surface.name);
      if (shades[i].receivers.empty() || !matches(shades[i].receivers, surface.name)) continue;
      shade.receivers.push_back(
          {id, areas[id], polygon_samples(surface.polygon, points_of_receiver)});
    }
    if (!shades[i].receivers.empty() && shade.receivers.empty()) {
      throw Error(fmt::format("{}: {} {}: no exterior surface matches{}", shades[i].where,
                              extension::moving_shade::receiver_name.title,
                              in_quotes(shades[i].receivers),
                              did_you_mean(shades[i].receivers, names)));
    }
    for (SurfaceId id = 0; id < scene.surfaces().size(); ++id) {
      if (scene.moving_shade_of(id) != i || area(scene.surfaces()[id].polygon) <= 0.0) continue;
      shade.first = id;
      break;
    }
    shades_.push_back(std::move(shade));
    decisions_.push_back({shades[i].rest, State::at_rest});
  }
  positions_ = scene.positions();
}

// A schedule that EnergyPlus lacks is an error at the start.
void ShadeControl::check_schedules() const {
  auto const& schedules = scene_.optics().schedules();
  for (auto const& shade : scene_.model().moving_shades) {
    if (!schedules.position) {
      throw Error(fmt::format("{}: shades can be moved only with --gpu-shading-method patched",
                              shade.where));
    }
    namespace field = extension::moving_shade;
    auto const check = [&](FieldInfo const& info, std::string const& name) {
      if (name.empty()) return;
      naming(fmt::format("{}: {}", shade.where, info.title), [&] { schedules.range(name); });
    };
    check(field::position_schedule_name, shade.schedule);
    check(field::availability_schedule_name, shade.availability);
  }
}

void ShadeControl::set_time(Moment moment) {
  moment_ = moment;
  auto const& schedules = scene_.optics().schedules();
  for (auto& [shade, outward, receivers, first, scheduled, available] : shades_) {
    scheduled = shade.rest;
    available = moment.timestep > 0;
    if (!available) continue;
    if (!shade.schedule.empty()) {
      scheduled = schedules.position(shade.schedule, moment);
    }
    if (!shade.availability.empty()) {
      available = schedules.position(shade.availability, moment) != 0.0;
    }
  }
}

std::vector<ShadeControl::Decision> const& ShadeControl::decide(std::optional<SunDirection> sun,
                                                                Weather const& weather) {
  std::vector<Decision> next;
  for (std::size_t i = 0; i < shades_.size(); ++i) {
    auto const& shade = shades_[i].shade;
    bool const known = moment_.timestep > 0 && shade.maximum_wind && weather.wind;
    bool const windy = known && weather.wind() > *shade.maximum_wind;
    double const exact = windy ? shade.rest : shades_[i].scheduled;
    next.push_back({shade.nearest(exact), windy ? State::windy : State::at_rest,
                    std::clamp(exact, shade.minimum, shade.maximum)});
    positions_[i] = next.back().position;
  }
  for (std::size_t i = 0; i < shades_.size(); ++i) {
    auto const& shade = shades_[i];
    auto& decision = next[i];
    if (decision.state == State::windy) continue;
    if (shade.shade.control == Control::schedule) {
      if (shade.available) decision.state = State::scheduled;
    } else if (sun && shade.available && has_beam(shade, *sun, weather.beam)) {
      decision =
          shade.shade.control == Control::block_beam ? block_beam(i, *sun) : track_sun(i, *sun);
    }
    positions_[i] = decision.position;
  }
  decisions_ = std::move(next);
  return decisions_;
}

bool ShadeControl::has_beam(Shade const& shade, SunDirection sun,
                            std::function<double()> const& beam) const {
  if (!shade.shade.minimum_beam) return true;
  double const irradiance = beam ? beam() : 0.0;
  auto const towards_sun = to_vector(sun);
  return std::any_of(shade.receivers.begin(), shade.receivers.end(), [&](Receiver const& each) {
    double const cosine = glm::dot(glm::normalize(each.area), towards_sun);
    return cosine > 0.0 && irradiance * cosine >= *shade.shade.minimum_beam;
  });
}

ShadeControl::Trial& ShadeControl::trial(std::size_t index, double position) {
  auto positions = positions_;
  positions[index] = position;
  std::pair key(index, positions);
  auto found = trials_.find(key);
  if (found == trials_.end()) {
    if (trials_.size() >= max_trials) trials_.clear();
    auto options = renderer_options(scene_.model().options);
    options.device.device = DeviceId{};  // of one direction and few receivers
    auto scene = scene_.scene_at(positions, ShadeOptics::Radiation::solar, index);
    found = trials_.try_emplace(std::move(key), std::move(scene), options).first;
  }
  return found->second;
}

// Rays find most beams; where they find none, the renderer is asked.
bool ShadeControl::is_lit(std::size_t index, double position, SunDirection sun) {
  auto const towards_sun = to_vector(sun);
  auto const& factors = scene_.optics().factors();
  auto const& deployments = scene_.optics().deployments();
  auto& scene = trial(index, position);
  std::vector<SurfaceId> unsure;
  for (auto& receiver : shades_[index].receivers) {
    if (glm::dot(receiver.area, towards_sun) <= 0.0) continue;
    auto const offset = ray_lift * glm::normalize(receiver.area);
    RayConditions conditions;
    conditions.receiver = receiver.id;
    conditions.factors = factors;
    conditions.deployments = deployments;
    auto const count = receiver.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      auto const at = (receiver.lit + i) % count;
      Ray const ray{receiver.points[at] + offset, towards_sun};
      if (scene.rays.transmittance(ray, conditions) <= 0.0) continue;
      receiver.lit = at;
      return true;
    }
    unsure.push_back(receiver.id);
  }
  if (unsure.empty()) return false;
  scene.renderer.set_deployments(deployments);
  auto const areas = scene.renderer.projected_sunlit_areas(sun, unsure);
  for (std::size_t i = 0; i < unsure.size(); ++i) {
    auto const& polygon = scene_.surfaces()[unsure[i]].polygon;
    double const all = area(polygon) * glm::dot(normal(polygon), towards_sun);
    if (areas[i].at(factors) > no_beam * all) return true;
  }
  return false;
}

// The present position if it is near enough to the wanted one, else that.
double ShadeControl::held(std::size_t index, double wanted) const {
  double const present = decisions_[index].position;
  return std::abs(wanted - present) <= shades_[index].shade.hysteresis ? present : wanted;
}

ShadeControl::Decision ShadeControl::block_beam(std::size_t index, SunDirection sun) {
  auto const& shade = shades_[index];
  for (double const wanted : shade.outward) {
    if (is_lit(index, wanted, sun)) continue;
    if (double const present = held(index, wanted);
        present != wanted && !is_lit(index, present, sun)) {
      return {present, State::held, present};
    }
    return {wanted, wanted == shade.shade.rest ? State::clear : State::blocking, wanted};
  }
  return {shade.outward.back(), State::admitting, shade.outward.back()};
}

ShadeControl::Decision ShadeControl::track_sun(std::size_t index, SunDirection sun) const {
  auto const& shade = shades_[index].shade;
  double const facing =
      facing_position(scene_.surfaces()[shades_[index].first].polygon, shade, to_vector(sun));
  // Either side may face the sun.
  auto const first = std::ceil((shade.minimum - facing) / half_circle);
  double best_exact = facing + half_circle * first;
  double best = shade.nearest(best_exact);
  double off = std::abs(best - best_exact);
  for (double turns = first - 1.0; facing + half_circle * turns <= shade.maximum + half_circle;
       ++turns) {
    double const exact = facing + half_circle * turns;
    double const position = shade.nearest(exact);
    double const error = std::abs(position - exact);
    // Both ends of the range may be off.
    bool const better = error < off - shade.step;
    bool const nearer =
        error < off + shade.step && std::abs(position - shade.rest) < std::abs(best - shade.rest);
    if (!better && !nearer) continue;
    best = position;
    best_exact = exact;
    off = error;
  }
  double const position = held(index, best);
  if (position != best) return {position, State::held, position};
  return {best, State::tracking, std::clamp(best_exact, shade.minimum, shade.maximum)};
}

std::string_view name_of(ShadeControl::State state) {
  constexpr std::array<std::string_view, 8> names{"at rest",   "scheduled", "clear", "blocking",
                                                  "admitting", "tracking",  "held",  "windy"};
  return names.at(static_cast<std::size_t>(state));
}

}  // namespace gpu_shading::energyplus
