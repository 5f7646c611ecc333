#include "hidden/hidden_luminance.h"

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// Of a side: as many as for solar reflections (HiddenReflections) where there are few casters, and
// fewer where a ray's neighbours meet other casters, so that errors cancel.
std::size_t samples_of(SceneAssembly const& scene) {
  constexpr std::size_t all = 25600;
  auto const hidden = std::max<std::size_t>(1, scene.surfaces().size() - scene.size());
  return std::clamp<std::size_t>(all / hidden, 16, 256);
}

}  // namespace

HiddenLuminance::HiddenLuminance(SceneAssembly const& scene)
    : casters_(scene, ShadeOptics::Radiation::light, samples_of(scene)) {}

std::size_t HiddenLuminance::Hash::operator()(std::array<double, 3> const& point) const noexcept {
  std::size_t hash = 0;
  for (double const coordinate : point) {
    hash = hash * 1'000'003U + std::hash<double>{}(coordinate);
  }
  return hash;
}

void HiddenLuminance::renew() { casters_.renew(); }

void HiddenLuminance::set_hour(int hour) {
  if (casters_.set_hour(hour)) last_path_.reset();
}

// EnergyPlus asks for the same ray hour by hour.
HiddenCasters::RayPath const& HiddenLuminance::path(Ray const& ray) {
  bool const same = last_path_ && ray.origin == last_.origin && ray.direction == last_.direction &&
                    ray.length == last_.length;
  if (!same) {
    last_ = ray;
    last_path_ = casters_.path(ray);
  }
  return *last_path_;
}

bool HiddenLuminance::meets(Ray const& ray) { return !path(ray).free; }

HiddenLuminance::View HiddenLuminance::view(Ray const& ray, int hour, glm::dvec3 const& to_sun) {
  set_hour(hour);
  auto const& met = path(ray);
  View view;
  view.passed = met.passed;
  for (auto const& layer : met.layers) {
    view.sky += layer.reflectance * casters_.sky_view(layer) / pi;
    double const cosine = glm::dot(layer.normal, to_sun);
    if (cosine <= 0.0) continue;
    double const reached =
        casters_.transmittance_of_all({layer.at, to_sun, Ray{}.length, layer.surface});
    view.sun += cosine * layer.reflectance * reached / pi;
  }
  return view;
}

double HiddenLuminance::transmittance(Ray const& ray, int hour) {
  set_hour(hour);
  return casters_.transmittance(ray);
}

std::optional<double> HiddenLuminance::sky_on_ground(glm::dvec3 const& point) {
  constexpr std::size_t max_skies = 1'000'000;
  set_hour(1);
  auto const version = casters_.sky_version();
  if (version != skies_version_ || skies_.size() >= max_skies) skies_.clear();
  skies_version_ = version;
  auto const [place, added] = skies_.try_emplace({point.x, point.y, point.z});
  if (added) place->second = seen_sky(point);
  return place->second;
}

std::optional<double> HiddenLuminance::seen_sky(glm::dvec3 const& point) const {
  auto const& patches = sky_patches_from_ground();
  std::vector<Ray> upward;
  upward.reserve(patches.size());
  for (auto const& patch : patches) upward.push_back({point, patch.direction});
  auto const hidden_pass = casters_.transmittances(upward);
  if (std::ranges::all_of(hidden_pass, [](double p) { return p >= 1.0; })) {
    return std::nullopt;
  }
  auto const all_pass = casters_.transmittances_of_all(upward);
  double seen = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < upward.size(); ++i) {
    seen += patches[i].share * all_pass[i];
    whole += patches[i].share;
  }
  return seen / whole;
}

}  // namespace gpu_shading::energyplus
