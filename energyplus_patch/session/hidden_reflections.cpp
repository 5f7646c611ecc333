#include "session/hidden_reflections.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "gpu_shading/perforated_screen.h"
#include "session/polygon_samples.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// A direction to the sky, and the share that it has of the irradiance on the horizontal.
struct SkyPatch {
  glm::dvec3 direction;
  double share;
};

// Patches of equal steps in altitude and in azimuth, from whose middles the sky shines.
std::vector<SkyPatch> sky_patches(int altitudes, int azimuths, double first_azimuth) {
  double const altitude_step = pi / 2.0 / altitudes;
  double const azimuth_step = 2.0 * pi / azimuths;
  std::vector<SkyPatch> patches;
  for (int i = 0; i < altitudes; ++i) {
    double const altitude = (i + 0.5) * altitude_step;
    double const solid_angle = std::cos(altitude) * azimuth_step * altitude_step;
    for (int j = 0; j < azimuths; ++j) {
      double const azimuth = (j + first_azimuth) * azimuth_step;
      glm::dvec3 const direction{std::cos(altitude) * std::cos(azimuth),
                                 std::cos(altitude) * std::sin(azimuth), std::sin(altitude)};
      patches.push_back({direction, direction.z * solid_angle / pi});
    }
  }
  return patches;
}

// Those that EnergyPlus's CalcSkySolDiffuseReflFactors sees from the ground.
std::vector<SkyPatch> const& patches_from_ground() {
  static auto const patches = sky_patches(5, 18, 0.5);
  return patches;
}

// Those of its SkyDifSolarShading.
std::vector<SkyPatch> const& patches_from_surfaces() {
  static auto const patches = sky_patches(6, 24, 0.0);
  return patches;
}

double deployed(Surface const& surface, std::span<double const> deployments) {
  auto const index = static_cast<std::size_t>(surface.deployment);
  return surface.deployment >= 0 && index < deployments.size() ? deployments[index] : 1.0;
}

}  // namespace

HiddenReflections::HiddenReflections(SceneAssembly const& scene)
    : scene_(scene), surfaces_(scene.scene()) {
  auto const casters = scene.hidden(surfaces_);
  if (casters.empty()) return;
  hidden_.emplace(surfaces_, RayOptions{.faces = RayFaces::both, .casters = casters});
  all_.emplace(surfaces_, RayOptions{.faces = RayFaces::both});
}

void HiddenReflections::set_rays(std::vector<ReflectionRay> rays) {
  rays_ = std::move(rays);
  ways_.clear();
  moment_.reset();
}

double HiddenReflections::transmittance(Ray const& ray, int hour) {
  trace(hour);
  return hidden_->transmittance(ray, conditions());
}

// Reads the schedules of an hour, and follows the rays again if they have changed.
void HiddenReflections::trace(int hour) {
  if (moment_ == hour) return;
  moment_ = hour;
  auto const& optics = scene_.optics();
  auto factors = optics.factors_at({hour, 1});
  auto deployments = optics.deployments_at({hour, 1});
  if (ways_.size() == rays_.size() && factors == factors_ && deployments == deployments_) return;
  factors_ = std::move(factors);
  deployments_ = std::move(deployments);
  ways_.clear();
  ways_.reserve(rays_.size());
  for (auto const& ray : rays_) ways_.push_back(way_of(ray));
}

HiddenReflections::Way HiddenReflections::way_of(ReflectionRay const& ray) const {
  Way way;
  for (auto const& met : hidden_->layers({ray.origin, ray.direction, ray.distance}, conditions())) {
    Layer layer;
    layer.surface = met.surface;
    layer.at = ray.origin + met.distance * ray.direction;
    layer.normal = normal(surfaces_[met.surface].polygon);
    if (glm::dot(layer.normal, ray.direction) > 0.0) layer.normal = -layer.normal;
    layer.reflectance = way.passed * reflectance(met.surface, met.transmittance);
    way.passed *= met.transmittance;
    if (layer.reflectance > 0.0) way.layers.push_back(layer);
  }
  return way;
}

double HiddenReflections::reflectance(SurfaceId id, double transmittance) const {
  auto const& surface = surfaces_[id];
  auto const& known = scene_.model().shading.shading_surfaces;
  auto const found = known.find(surface.name);
  double share =
      found == known.end() ? ShadingInput::ShadingSurface{}.reflectance : found->second.reflectance;
  if (surface.screen) {
    share *= deployed(surface, deployments_) * (1.0 - surface.screen->open_fraction());
  }
  return std::min(share, 1.0 - transmittance);
}

double HiddenReflections::all_pass(Ray const& ray, SurfaceId const* excluded) const {
  auto conditions = this->conditions();
  if (excluded != nullptr) conditions.excluded = {excluded, 1};
  return all_->transmittance(ray, conditions);
}

std::vector<ReflectedShare> const& HiddenReflections::beam(Sun const& sun) {
  auto const& to_sun = sun.direction;
  trace(sun.hour);
  lit_.clear();
  shares_.assign(rays_.size(), {});
  std::vector<Ray> from_hits;
  for (auto const& ray : rays_) {
    // Of no length: without anything on its way.
    bool const sky = ray.meets == ReflectionRay::Meets::sky;
    from_hits.push_back({ray.hit, to_sun, sky ? 0.0 : Ray{}.length});
  }
  std::vector<double> passed(rays_.size());
  hidden_->transmittances(from_hits, conditions(), passed);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    auto const& way = ways_[i];
    auto& share = shares_[i];
    share.kept = way.passed * passed[i];
    if (rays_[i].meets == ReflectionRay::Meets::ground && share.kept < 1.0) {
      if (share.kept > 0.0) share.ground = way.passed * all_pass(from_hits[i]);
      share.kept = 0.0;
    }
    for (auto const& layer : way.layers) {
      double const cosine = glm::dot(layer.normal, to_sun);
      if (cosine <= 0.0) continue;
      double const reached = all_pass({layer.at, to_sun}, &layer.surface);
      if (reached > 0.0 && lit(layer, sun.at_first_timestep)) {
        share.shades += cosine * layer.reflectance * reached;
      }
    }
  }
  return shares_;
}

std::vector<ReflectedShare> const& HiddenReflections::sky() {
  trace(1);
  sky_views_.clear();
  shares_.assign(rays_.size(), {});
  for (std::size_t i = 0; i < rays_.size(); ++i) shares_[i] = sky_share(rays_[i], ways_[i]);
  return shares_;
}

ReflectedShare HiddenReflections::sky_share(ReflectionRay const& ray, Way const& way) {
  ReflectedShare share;
  share.kept = way.passed;
  for (auto const& layer : way.layers) share.shades += layer.reflectance * sky_view(layer);
  if (ray.meets != ReflectionRay::Meets::ground || way.passed <= 0.0) return share;

  std::vector<Ray> upward;
  for (auto const& patch : patches_from_ground()) upward.push_back({ray.hit, patch.direction});
  std::vector<double> passed(upward.size());
  hidden_->transmittances(upward, conditions(), passed);
  bool const free = std::all_of(passed.begin(), passed.end(), [](double p) { return p >= 1.0; });
  if (free && way.passed >= 1.0) return share;
  all_->transmittances(upward, conditions(), passed);
  for (std::size_t i = 0; i < upward.size(); ++i) {
    share.ground += way.passed * patches_from_ground()[i].share * passed[i];
  }
  share.kept = 0.0;
  return share;
}

HiddenReflections::Side HiddenReflections::side_of(Layer const& layer) const {
  return {layer.surface, glm::dot(layer.normal, normal(surfaces_[layer.surface].polygon)) > 0.0};
}

std::vector<glm::dvec3> const& HiddenReflections::samples(SurfaceId surface) {
  // Sky views differ from EnergyPlus's by 0.3 % with them, and by 4 % with 16.
  constexpr std::size_t count = 256;
  auto const [place, added] = samples_.try_emplace(surface);
  if (added) place->second = polygon_samples(surfaces_[surface].polygon, count);
  return place->second;
}

// Whether at least a hundredth of a side is in the sun.
bool HiddenReflections::lit(Layer const& layer, std::optional<glm::dvec3> const& to_sun) {
  if (!to_sun || glm::dot(layer.normal, *to_sun) <= 0.0) return false;
  auto const [place, added] = lit_.try_emplace(side_of(layer), false);
  if (!added) return place->second;
  auto const& points = samples(layer.surface);
  double wanted = 0.01 * static_cast<double>(points.size());
  for (auto const& point : points) {
    wanted -= all_pass({point, *to_sun}, &layer.surface);
    if (wanted <= 0.0) return place->second = true;
  }
  return false;
}

// The irradiance from the sky on a side of a hidden caster, over that on the horizontal without
// obstructions.
double HiddenReflections::sky_view(Layer const& layer) {
  auto const [place, added] = sky_views_.try_emplace(side_of(layer), 0.0);
  if (!added) return place->second;
  auto const& points = samples(layer.surface);
  std::vector<Ray> rays;
  std::vector<double> weights;
  double whole = 0.0;
  for (auto const& patch : patches_from_surfaces()) {
    double const cosine = glm::dot(patch.direction, layer.normal);
    if (cosine <= 0.0) continue;
    double const weight = cosine * patch.share / patch.direction.z;
    whole += weight * static_cast<double>(points.size());
    for (auto const& point : points) {
      rays.push_back({point, patch.direction});
      weights.push_back(weight);
    }
  }
  if (rays.empty()) return 0.0;
  auto conditions = this->conditions();
  conditions.excluded = {&layer.surface, 1};
  std::vector<double> passed(rays.size());
  all_->transmittances(rays, conditions, passed);
  double seen = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) seen += weights[i] * passed[i];
  // EnergyPlus's view factor of the sky, times its ratio of shaded to unshaded.
  place->second = 0.5 * (1.0 + layer.normal.z) * seen / whole;
  return place->second;
}

}  // namespace gpu_shading::energyplus
