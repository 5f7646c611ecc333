#include "calculation/shade_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "gpu_shading/error.h"
#include "platform/named_entries.h"
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
// Of a sunlit fraction: a bound for that of rays from the points of a receiver, and what positions
// must differ by to be told apart.
constexpr double ray_error = 0.06;
constexpr double same_beam = 1e-3;
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
  for (auto const& shade : scene.model().moving_shades) {
    shades_.push_back({shade, from_rest(shade), {}});
    decisions_.push_back({shade.rest, State::at_rest});
  }
  find_receivers();
  find_first_surfaces();
  positions_ = scene.positions();
}

void ShadeControl::find_receivers() {
  auto const areas = scene_.areas();
  std::multimap<std::string, SurfaceId> by_name;
  for (auto const id : scene_.receivers()) {
    if (!scene_.moving_shade_of(id)) by_name.emplace(upper(scene_.surfaces()[id].name), id);
  }
  for (auto& entry : shades_) {
    auto const& shade = entry.shade;
    if (shade.receivers.empty()) continue;
    for_each_match(by_name, shade.receivers, [&](auto const& found) {
      auto const id = found.second;
      entry.receivers.push_back(
          {id, areas[id], polygon_samples(scene_.surfaces()[id].polygon, points_of_receiver)});
    });
    if (!entry.receivers.empty()) continue;
    std::vector<std::string> names;
    for (auto const& [name, id] : by_name) names.push_back(name);
    throw Error(fmt::format("{}: {} {}: no exterior surface matches{}", shade.where,
                            extension::moving_shade::receiver_name.title,
                            in_quotes(shade.receivers), did_you_mean(shade.receivers, names)));
  }
}

void ShadeControl::find_first_surfaces() {
  for (auto id = static_cast<SurfaceId>(scene_.surfaces().size()); id-- > 0;) {
    auto const shade = scene_.moving_shade_of(id);
    if (shade && area(scene_.surfaces()[id].polygon) > 0.0) shades_[*shade].first = id;
  }
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

double ShadeControl::value_of(MovingShade const& shade, FieldInfo const& field,
                              std::string const& schedule) const {
  try {
    return scene_.optics().schedules().position(schedule, moment_);
  } catch (Error const& error) {
    throw Error(fmt::format("{}: {}: {}", shade.where, field.title, error.what()));
  }
}

void ShadeControl::set_time(Moment moment) {
  namespace field = extension::moving_shade;
  moment_ = moment;
  for (auto& [shade, outward, receivers, first, scheduled, available] : shades_) {
    scheduled = shade.rest;
    available = moment.timestep > 0;
    if (!available) continue;
    if (!shade.schedule.empty()) {
      scheduled = value_of(shade, field::position_schedule_name, shade.schedule);
    }
    if (!shade.availability.empty()) {
      available = value_of(shade, field::availability_schedule_name, shade.availability) != 0.0;
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

// Rays find most beams; where they find too few, the renderer is asked.
bool ShadeControl::is_lit(std::size_t index, double position, SunDirection sun) {
  auto const towards_sun = to_vector(sun);
  double const tolerance = shades_[index].shade.tolerance;
  auto& scene = trial(index, position);
  for (auto& receiver : shades_[index].receivers) {
    if (glm::dot(receiver.area, towards_sun) <= 0.0) continue;
    auto const conditions = conditions_of(receiver.id);
    auto const offset = ray_lift * glm::normalize(receiver.area);
    auto const count = receiver.points.size();
    double const most =
        tolerance > 0.0 ? (tolerance + ray_error) * static_cast<double>(count) : 0.0;
    double passed = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      auto const at = (receiver.lit + i) % count;
      passed += scene.rays.transmittance({receiver.points[at] + offset, towards_sun}, conditions);
      if (passed <= most) continue;
      receiver.lit = at;
      return true;
    }
  }
  return rendered_beam(index, position, sun).largest > std::max(no_beam, tolerance);
}

RayConditions ShadeControl::conditions_of(SurfaceId receiver) const {
  RayConditions conditions;
  conditions.receiver = receiver;
  conditions.factors = scene_.optics().factors();
  conditions.deployments = scene_.optics().deployments();
  return conditions;
}

double ShadeControl::estimated_beam(std::size_t index, double position, SunDirection sun) {
  auto const towards_sun = to_vector(sun);
  auto const& rays = trial(index, position).rays;
  double lit = 0.0;
  double all = 0.0;
  for (auto const& receiver : shades_[index].receivers) {
    double const facing = glm::dot(receiver.area, towards_sun);
    if (facing <= 0.0) continue;
    auto const offset = ray_lift * glm::normalize(receiver.area);
    batch_.clear();
    for (auto const& point : receiver.points) batch_.push_back({point + offset, towards_sun});
    passed_.resize(batch_.size());
    rays.transmittances(batch_, conditions_of(receiver.id), passed_);
    lit += facing * std::accumulate(passed_.begin(), passed_.end(), 0.0) /
           static_cast<double>(batch_.size());
    all += facing;
  }
  return all > 0.0 ? lit / all : 0.0;
}

ShadeControl::Beam ShadeControl::rendered_beam(std::size_t index, double position,
                                               SunDirection sun) {
  auto const towards_sun = to_vector(sun);
  std::vector<SurfaceId> ids;
  for (auto const& receiver : shades_[index].receivers) {
    if (glm::dot(receiver.area, towards_sun) > 0.0) ids.push_back(receiver.id);
  }
  Beam beam;
  if (ids.empty()) return beam;
  auto& renderer = trial(index, position).renderer;
  renderer.set_deployments(scene_.optics().deployments());
  auto const areas = renderer.projected_sunlit_areas(sun, ids);
  double all = 0.0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    auto const& polygon = scene_.surfaces()[ids[i]].polygon;
    double const facing = area(polygon) * glm::dot(normal(polygon), towards_sun);
    double const lit = areas[i].at(scene_.optics().factors());
    beam.total += lit;
    beam.largest = std::max(beam.largest, lit / facing);
    all += facing;
  }
  beam.total /= all;
  return beam;
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
  return least_beam(index, sun);
}

// Rays choose the positions that may have the least, and the renderer decides between them. The
// nearest to rest comes first.
ShadeControl::Decision ShadeControl::least_beam(std::size_t index, SunDirection sun) {
  auto const& outward = shades_[index].outward;
  std::vector<double> beams;
  beams.reserve(outward.size());
  for (double const position : outward) beams.push_back(estimated_beam(index, position, sun));
  double const most = *std::ranges::min_element(beams) + 2.0 * ray_error;
  for (std::size_t i = 0; i < outward.size(); ++i) {
    beams[i] = beams[i] > most ? 1.0 : rendered_beam(index, outward[i], sun).total;
  }
  double const enough = *std::ranges::min_element(beams) + same_beam;
  auto const best = std::ranges::find_if(beams, [&](double beam) { return beam <= enough; });
  double const wanted = outward[static_cast<std::size_t>(best - beams.begin())];
  double const present = held(index, wanted);
  if (present != wanted && rendered_beam(index, present, sun).total <= enough) {
    return {present, State::held, present};
  }
  return {wanted, State::admitting, wanted};
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
