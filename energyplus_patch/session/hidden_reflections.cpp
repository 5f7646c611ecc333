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
  std::vector<Ray> rays;
  for (auto const& ray : rays_) rays.push_back({ray.origin, ray.direction, ray.distance});
  std::vector<std::vector<RayLayer>> met(rays.size());
  hidden_->layers(rays, conditions(), met);
  ways_.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) ways_.push_back(way_of(rays[i], met[i]));
}

HiddenReflections::Way HiddenReflections::way_of(Ray const& ray,
                                                 std::vector<RayLayer> const& layers) const {
  Way way;
  for (auto const& met : layers) {
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

std::vector<double> HiddenReflections::passed(RayScene const& scene,
                                              std::vector<Ray> const& rays) const {
  std::vector<double> passed(rays.size());
  scene.transmittances(rays, conditions(), passed);
  return passed;
}

std::vector<ReflectedShare> const& HiddenReflections::beam(Sun const& sun) {
  trace(sun.hour);
  lit_.clear();
  shares_.assign(rays_.size(), {});
  keep(sun.direction);
  reflect(sun);
  return shares_;
}

// What EnergyPlus's own surfaces and the ground reflect.
void HiddenReflections::keep(glm::dvec3 const& to_sun) {
  std::vector<Ray> to_the_sun;
  for (auto const& ray : rays_) {
    bool const wanted = ray.meets != ReflectionRay::Meets::sky;
    to_the_sun.push_back({ray.hit, to_sun, wanted ? Ray{}.length : 0.0});
  }
  auto const hidden_pass = passed(*hidden_, to_the_sun);
  std::vector<std::size_t> dimmed;
  std::vector<Ray> from_dimmed;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    auto& kept = shares_[i].kept;
    kept = ways_[i].passed * hidden_pass[i];
    if (rays_[i].meets != ReflectionRay::Meets::ground || kept >= 1.0) continue;
    if (kept > 0.0) {
      dimmed.push_back(i);
      from_dimmed.push_back(to_the_sun[i]);
    }
    kept = 0.0;
  }
  auto const all_pass = passed(*all_, from_dimmed);
  for (std::size_t i = 0; i < dimmed.size(); ++i) {
    shares_[dimmed[i]].ground = ways_[dimmed[i]].passed * all_pass[i];
  }
}

// What hidden casters reflect.
void HiddenReflections::reflect(Sun const& sun) {
  struct Facing {
    std::size_t ray;
    Layer const* layer;
    double cosine;
  };
  std::vector<Facing> facing;
  std::vector<Ray> to_the_sun;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    for (auto const& layer : ways_[i].layers) {
      double const cosine = glm::dot(layer.normal, sun.direction);
      if (cosine <= 0.0) continue;
      facing.push_back({i, &layer, cosine});
      to_the_sun.push_back({layer.at, sun.direction, Ray{}.length, layer.surface});
    }
  }
  auto const reached = passed(*all_, to_the_sun);
  for (std::size_t i = 0; i < facing.size(); ++i) {
    auto const& [ray, layer, cosine] = facing[i];
    if (reached[i] > 0.0 && lit(*layer, sun.at_first_timestep)) {
      shares_[ray].shades += cosine * layer->reflectance * reached[i];
    }
  }
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
  auto const hidden_pass = passed(*hidden_, upward);
  bool const free =
      std::all_of(hidden_pass.begin(), hidden_pass.end(), [](double p) { return p >= 1.0; });
  if (free && way.passed >= 1.0) return share;
  auto const all_pass = passed(*all_, upward);
  for (std::size_t i = 0; i < upward.size(); ++i) {
    share.ground += way.passed * patches_from_ground()[i].share * all_pass[i];
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
    wanted -= all_->transmittance({point, *to_sun, Ray{}.length, layer.surface}, conditions());
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
      rays.push_back({point, patch.direction, Ray{}.length, layer.surface});
      weights.push_back(weight);
    }
  }
  if (rays.empty()) return 0.0;
  auto const all_pass = passed(*all_, rays);
  double seen = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) seen += weights[i] * all_pass[i];
  // EnergyPlus's view factor of the sky, times its ratio of shaded to unshaded.
  place->second = 0.5 * (1.0 + layer.normal.z) * seen / whole;
  return place->second;
}

}  // namespace gpu_shading::energyplus
