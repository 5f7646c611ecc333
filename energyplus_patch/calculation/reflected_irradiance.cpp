#include "calculation/reflected_irradiance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "gpu_shading/rays.h"
#include "gpu_shading/sun_position.h"
#include "platform/text.h"
#include "reports/sky_mask.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

// EnergyPlus's own default.
constexpr double usual_ground = 0.2;
// Of a schedule's values, between which light is interpolated.
constexpr double schedule_step = 0.25;

// The sun of a year in which every second hour is clear: only what errors are relative to, so that
// they do not depend on the weather. Clear beam: A. B. Meinel and M. P. Meinel, "Applied Solar
// Energy", 1976; the sky's light is that of a bright overcast.
std::vector<TransportHour> ordinary_year(double latitude) {
  constexpr int days = 365;
  constexpr int days_apart = 15;
  constexpr int hours_of_day = 24;
  constexpr double half_of_time = 0.5;
  constexpr double solar_constant = 1353.0;
  constexpr double overcast = 200.0;  // W/m2, of a sun in the zenith
  std::vector<TransportHour> hours;
  for (int day = 1; day <= days; day += days_apart) {
    double const declination = sun_of_day(day).declination;
    // Other minutes on each day: suns lie anywhere in the cells of a table of full hours.
    double const later = std::fmod(day / std::numbers::phi, 1.0);
    for (int hour = 0; hour < hours_of_day; ++hour) {
      HourDirection const sun{declination,
                              (2.0 * (hour + later) / hours_of_day - 1.0) * std::numbers::pi};
      double const height = to_vector(to_direction(sun, latitude)).z;
      if (height <= 0.0) continue;
      double const clear = solar_constant * std::pow(0.7, std::pow(height, -0.678));
      hours.push_back({sun, half_of_time * clear, overcast * height});
    }
  }
  return hours;
}

// The lowest point of some surfaces: EnergyPlus's ground, or that beyond the terrain.
double lowest_of(Scene const& scene, std::vector<SurfaceId> const& ids) {
  double lowest = std::numeric_limits<double>::infinity();
  for (auto const id : ids) {
    for (auto const& point : scene[id].polygon.outline) lowest = std::min(lowest, point.z);
  }
  return lowest;
}

// What paths meet, and how it reflects.
struct Reflectors {
  std::vector<SurfaceId> casters;
  std::vector<FaceReflectances> reflectances;  // by surface of the scene
  double ground_height = 0.0;
};

FaceReflectances reflectances_of(Model const& model, std::string const& name) {
  auto const& finishes = model.reflected_light.reflectances;
  auto const& mirrors = model.reflected_light.mirrors;
  FaceReflectances faces;
  double glazed = 1.0;
  if (auto const shade = model.shading.shading_surfaces.find(name);
      shade != model.shading.shading_surfaces.end()) {
    glazed = shade->second.glazed;
    faces.front = shade->second.reflectance * (1.0 - glazed);
    faces.back = faces.front;
  } else if (auto const finish = finishes.find(name); finish != finishes.end()) {
    faces.front = finish->second;
  }
  if (auto const mirror = mirrors.find(name); mirror != mirrors.end()) {
    faces.grazing = glazed;
    faces.specular = std::min(glazed * mirror->second, 1.0 - faces.front);
  }
  return faces;
}

Reflectors reflectors_of(SceneAssembly const& assembly, Scene const& scene, double ground) {
  auto const& model = assembly.model();
  auto const kinds = kinds_of(assembly, scene);
  Reflectors made;
  made.reflectances.resize(scene.size());
  std::vector<SurfaceId> terrain;
  // Copies of walls without their openings come after these.
  for (SurfaceId id = 0; id < assembly.surfaces().size(); ++id) {
    auto const& name = scene[id].name;
    bool const opening = model.shading.base_of.contains(name) && model.shading.receives(name);
    if (scene[id].casting == Casting::never && !opening) continue;
    made.casters.push_back(id);
    auto& faces = made.reflectances[id];
    if (kinds[id] == ShadeKind::terrain) {
      terrain.push_back(id);
      faces = {ground, ground, true};
    } else {
      faces = reflectances_of(model, name);
    }
  }
  made.ground_height = lowest_of(scene, terrain.empty() ? assembly.shown_receivers() : terrain);
  return made;
}

// Values of schedules on their grid to interpolate between.
std::vector<WeightedPositions> around(std::vector<double> const& values) {
  std::vector<double> low(values.size());
  std::vector<BetweenSteps> between;
  constexpr double negligible = 1e-6;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double const place = values[i] / schedule_step;
    double const below = std::floor(place + negligible);
    low[i] = below * schedule_step;
    if (place - below > negligible) between.push_back({place - below, i, low[i] + schedule_step});
  }
  return simplex_from(std::move(low), std::move(between));
}

std::vector<glm::dvec3> patch_directions() {
  std::vector<glm::dvec3> directions;
  for (auto const& patch : sky_patches()) directions.push_back(to_vector(patch));
  return directions;
}

// Makes the lights of a table, which are patches of the sky, those of patches with a radiance of
// 1/sr. The patches' middles stand for them, so that a uniform sky is what its own rays say.
void weigh_patches(Transported& table) {
  auto const upward = patch_projections({0.0, 0.0, 1.0});
  LightByGround uniform;
  for (std::size_t patch = 0; patch < table.lights.size(); ++patch) {
    auto& light = table.lights[patch];
    light = patch_solid_angles()[patch] * light;
    uniform += 1.0 / std::numbers::pi * light;
  }
  for (std::size_t patch = 0; patch < table.lights.size(); ++patch) {
    // Where no ray to a patch found any, all of a sky's light is the uniform one's.
    auto const scaled = [&](double of_all, double part, double whole) {
      return of_all * (whole > 0.0 ? part / whole : upward[patch]);
    };
    auto& light = table.lights[patch];
    light = {scaled(table.sky.none, light.none, uniform.none),
             scaled(table.sky.once, light.once, uniform.once),
             scaled(table.sky.more, light.more, uniform.more)};
  }
}

// Of a sky with these radiances of its patches, 1/sr, that gives 1 W/m2 to level ground in the
// open.
LightByGround light_of_sky(Transported const& table, std::vector<double> const& radiances) {
  LightByGround light;
  for (std::size_t patch = 0; patch < radiances.size(); ++patch) {
    light += radiances[patch] * table.lights[patch];
  }
  return light;
}

// What a tracing is for, and how accurate it has to be.
struct Tracing {
  std::vector<SurfaceId> const& receivers;
  double ground;  // its reflectance
  TransportRequest const& request;
};

std::vector<Transported> trace(SceneAssembly const& assembly, std::vector<double> const& positions,
                               RayConditions const& conditions, Tracing const& tracing) {
  auto const scene = assembly.scene_at(positions);
  auto reflectors = reflectors_of(assembly, scene, tracing.ground);
  RayScene const rays(scene, {RayFaces::both, ScreenDetail::automatic, reflectors.casters});
  Transport const transport(scene, rays, std::move(reflectors.reflectances),
                            ReflectingGround{reflectors.ground_height, tracing.ground});
  return transport.to(tracing.receivers, tracing.request, conditions);
}

constexpr double percent = 100.0;

double hourly_error(Transported const& table) {
  return std::hypot(table.noise, table.interpolation);
}

double annual_error(Transported const& table) {
  return std::hypot(table.annual_noise, table.annual_interpolation);
}

}  // namespace

ReflectedIrradiance::ReflectedIrradiance(SceneAssembly const& scene, double latitude,
                                         Messages messages)
    : scene_(scene), latitude_(latitude), messages_(std::move(messages)) {
  std::unordered_map<std::string, SurfaceId> by_name;
  for (SurfaceId id = 0; id < scene.size(); ++id) by_name.emplace(scene.surfaces()[id].name, id);
  for (auto const& receiver : scene.model().reflected_light.receivers) {
    auto const found = by_name.find(receiver.surface);
    if (found == by_name.end()) {
      at_.emplace_back();
      continue;
    }
    at_.emplace_back(ids_.size());
    ids_.push_back(found->second);
  }
}

std::vector<ReflectedIrradiance::WeightedState> ReflectedIrradiance::states(
    Moment moment, std::vector<WeightedPositions> const& corners) const {
  auto const& optics = scene_.optics();
  auto schedules = optics.factors_at(moment);
  auto const deployments = optics.deployments_at(moment);
  schedules.insert(schedules.end(), deployments.begin(), deployments.end());
  std::vector<WeightedState> states;
  for (auto const& [values, share] : around(schedules)) {
    for (auto const& [positions, weight] : corners) {
      states.push_back({{positions, values}, share * weight});
    }
  }
  return states;
}

std::vector<Transported> ReflectedIrradiance::trace(State const& state) const {
  auto const hours = ordinary_year(latitude_);
  std::vector<glm::dvec3> patches;
  if (scene_.model().options.weighs_sky_patches()) patches = patch_directions();
  TransportRequest const request{.latitude = latitude_, .hours = hours, .lights = patches};
  std::span const schedules(state.schedules);
  auto const factors = scene_.optics().factors().size();
  auto tables = energyplus::trace(
      scene_, state.positions,
      {.factors = schedules.first(factors), .deployments = schedules.subspan(factors)},
      {ids_, traced_ground_, request});
  if (scene_.model().options.weighs_sky_patches()) std::ranges::for_each(tables, weigh_patches);
  return tables;
}

std::vector<Transported> const& ReflectedIrradiance::traced(State const& state) {
  auto const [place, added] = known_.try_emplace(state);
  if (added) {
    place->second = trace(state);
    list(place->second);
  }
  return place->second;
}

std::vector<Reflected> ReflectedIrradiance::at(Time const& time,
                                               std::vector<WeightedPositions> const& corners) {
  auto const& [moment, weather, ground] = time;
  if (traced_ground_ <= 0.0) traced_ground_ = ground > 0.0 ? ground : usual_ground;
  double const ratio = ground / traced_ground_;
  auto const sun = to_hour_direction(to_direction(weather.towards_sun), latitude_);
  std::vector<double> radiances;
  if (scene_.model().options.weighs_sky_patches() && weather.diffuse > 0.0)
    radiances = perez_radiances(weather);
  std::vector<Reflected> all(at_.size());
  for (auto const& [state, weight] : states(moment, corners)) {
    auto const& tables = traced(state);
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (!at_[i]) continue;
      auto const& table = tables[*at_[i]];
      auto const beam = table.beam_at(sun);
      auto const sky = radiances.empty() ? table.sky : light_of_sky(table, radiances);
      double const shades = weather.beam * beam.none + weather.diffuse * sky.none;
      double const sum = weather.beam * beam.at(ratio) + weather.diffuse * sky.at(ratio);
      all[i].by_shades += weight * shades;
      all[i].by_ground += weight * (sum - shades);
    }
  }
  for (std::size_t i = 0; i < at_.size(); ++i) {
    if (at_[i]) continue;
    // EnergyPlus's own light from the ground.
    all[i].by_ground =
        weather.open_ground() * ground * scene_.model().reflected_light.receivers[i].ground_view;
  }
  return all;
}

void ReflectedIrradiance::list(std::vector<Transported> const& tables) const {
  if (known_.size() == 1) {
    messages_.eio(
        "! <GPU Shading Reflected Light>, State of the Shades, Surface Name, Rays, Error of Hours "
        "{%}, Error of a Year {%}\n");
  }
  for (std::size_t i = 0; i < tables.size(); ++i) {
    auto name = scene_.surfaces()[ids_[i]].name;
    std::ranges::replace(name, ',', ';');  // commas separate the file's fields
    messages_.eio(fmt::format("GPU Shading Reflected Light,{},{},{},{:.2g},{:.2g}\n", known_.size(),
                              name, tables[i].rays, percent * hourly_error(tables[i]),
                              percent * annual_error(tables[i])));
  }
}

void ReflectedIrradiance::describe() const {
  if (known_.empty() || ids_.empty()) return;
  double hourly = 0.0;
  double annual = 0.0;
  double rays = 0.0;
  SurfaceId worst = ids_.front();
  for (auto const& [state, tables] : known_) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      rays += static_cast<double>(tables[i].rays);
      if (hourly_error(tables[i]) > hourly) worst = ids_[i];
      hourly = std::max(hourly, hourly_error(tables[i]));
      annual = std::max(annual, annual_error(tables[i]));
    }
  }
  messages_.remark(fmt::format(
      "light that ground, shades and neighbours reflect: traced by {:.2g} million rays for {} "
      "surface{}{}; measured errors are at most {:.2g} % of the hourly light and {:.2g} % of a "
      "year's, for {}",
      rays / 1e6, ids_.size(), ids_.size() == 1 ? "" : "s",
      known_.size() > 1 ? fmt::format(" and {} states of shades", known_.size()) : "",
      percent * hourly, percent * annual, printable(scene_.surfaces()[worst].name)));
}

std::vector<double> undimmed_to_traced(SceneAssembly const& scene, double latitude,
                                       std::vector<SurfaceId> const& ids) {
  auto const hours = ordinary_year(latitude);
  TransportRequest const request{
      .latitude = latitude, .hours = hours, .hourly = 0.2, .annual = 0.05};
  auto const& optics = scene.optics();
  auto const tables = trace(scene, scene.positions(),
                            {.factors = optics.factors(), .deployments = optics.deployments()},
                            {ids, usual_ground, request});
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    double const view = 0.5 * (1.0 - normal(scene.surfaces()[ids[i]].polygon).z);
    double undimmed = 0.0;
    double traced = 0.0;
    for (auto const& hour : hours) {
      double const height = to_vector(to_direction(hour.sun, latitude)).z;
      undimmed += (hour.beam * height + hour.diffuse) * usual_ground * view;
      traced += hour.beam * tables[i].beam_at(hour.sun).sum() + hour.diffuse * tables[i].sky.sum();
    }
    ratios.push_back(undimmed / traced);
  }
  return ratios;
}

double ground_reflectance(double irradiance, double open, double ground_view) {
  return std::max(min_ground_reflectance, irradiance / (open * ground_view));
}

}  // namespace gpu_shading::energyplus
