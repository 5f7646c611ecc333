#include "hidden/hidden_casters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/flat_polygon.h"
#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {
namespace {

using std::numbers::pi;

// Patches of equal steps in altitude and in azimuth, from whose middles the sky shines.
std::vector<SkyShare> sky_patches(int altitudes, int azimuths, double first_azimuth) {
  double const altitude_step = pi / 2.0 / altitudes;
  double const azimuth_step = 2.0 * pi / azimuths;
  std::vector<SkyShare> patches;
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

// Those of EnergyPlus's SkyDifSolarShading.
std::vector<SkyShare> const& patches_from_surfaces() {
  static auto const patches = sky_patches(sky_rows, sky_columns, 0.0);
  return patches;
}

}  // namespace

HourShares::Shares const& HourShares::at(int hour) {
  int const nearest = std::clamp(hour, 1, static_cast<int>(hours));
  auto& shares = known_.at(static_cast<std::size_t>(nearest - 1));
  if (!shares) {
    Moment const moment{nearest, 1};
    shares = Shares{optics_.factors_at(moment), optics_.deployments_at(moment)};
  }
  return *shares;
}

HiddenObstructions::HiddenObstructions(SceneAssembly const& scene) : shares_(scene.optics()) {
  auto const casters = scene.hidden_casters();
  if (casters.size() > 0) rays_.emplace(casters, RayOptions{.faces = RayFaces::both});
}

double HiddenObstructions::transmittance(Ray const& ray, int hour) {
  return rays_ ? rays_->transmittance(ray, shares_.at(hour).conditions()) : 1.0;
}

std::vector<SkyShare> const& sky_patches_from_ground() {
  static auto const patches = sky_patches(5, 18, 0.5);
  return patches;
}

HiddenCasters::HiddenCasters(SceneAssembly const& scene, ShadeOptics::Radiation radiation,
                             std::size_t samples)
    : scene_(scene),
      radiation_(radiation),
      sample_count_(samples),
      surfaces_(scene.scene(radiation)),
      by_hour_(scene.optics()) {
  auto const casters = scene.hidden(surfaces_);
  if (casters.empty()) return;
  hidden_.emplace(surfaces_, RayOptions{.faces = RayFaces::both, .casters = casters});
  all_.emplace(surfaces_, RayOptions{.faces = RayFaces::both});
}

bool HiddenCasters::set_hour(int hour) {
  auto const& shares = by_hour_.at(hour);
  if (shares == shares_) return false;
  shares_ = shares;
  return true;
}

std::vector<HiddenCasters::RayPath> HiddenCasters::paths(std::span<Ray const> rays) const {
  std::vector<std::vector<RayLayer>> met(rays.size());
  hidden_->layers(rays, conditions(), met);
  std::vector<RayPath> paths;
  for (std::size_t i = 0; i < rays.size(); ++i) paths.push_back(path_of(rays[i], met[i]));
  return paths;
}

HiddenCasters::RayPath HiddenCasters::path(Ray const& ray) const {
  return path_of(ray, hidden_->layers(ray, conditions()));
}

HiddenCasters::RayPath HiddenCasters::path_of(Ray const& ray,
                                              std::vector<RayLayer> const& layers) const {
  RayPath path;
  path.free = layers.empty();
  auto const along = glm::normalize(ray.direction);
  for (auto const& met : layers) {
    Layer layer;
    layer.surface = met.surface;
    layer.at = ray.origin + met.distance * along;
    layer.normal = normal(surfaces_[met.surface].polygon);
    if (glm::dot(layer.normal, along) > 0.0) layer.normal = -layer.normal;
    layer.reflectance = path.passed * reflectance(met.surface, met.transmittance);
    path.passed *= met.transmittance;
    if (layer.reflectance > 0.0) path.layers.push_back(layer);
  }
  return path;
}

double HiddenCasters::reflectance(SurfaceId id, double transmittance) const {
  auto const& surface = surfaces_[id];
  auto const& known = scene_.model().shading.shading_surfaces;
  auto const found = known.find(surface.name);
  ShadingInput::ShadingSurface const unknown;
  auto const& properties = found == known.end() ? unknown : found->second;
  double share = radiation_ == ShadeOptics::Radiation::light ? properties.visible_reflectance
                                                             : properties.reflectance;
  share *= surface.filter.solid_share(shares_.deployments);
  return std::min(share, 1.0 - transmittance);
}

std::vector<double> HiddenCasters::transmittances(std::span<Ray const> rays) const {
  std::vector<double> passed(rays.size());
  hidden_->transmittances(rays, conditions(), passed);
  return passed;
}

std::vector<double> HiddenCasters::transmittances_of_all(std::span<Ray const> rays) const {
  std::vector<double> passed(rays.size());
  all_->transmittances(rays, conditions(), passed);
  return passed;
}

HiddenCasters::Side HiddenCasters::side_of(Layer const& layer) const {
  return {layer.surface, glm::dot(layer.normal, normal(surfaces_[layer.surface].polygon)) > 0.0};
}

std::vector<glm::dvec3> const& HiddenCasters::samples(SurfaceId surface) {
  auto const [place, added] = samples_.try_emplace(surface);
  if (added) place->second = polygon_samples(surfaces_[surface].polygon, sample_count_);
  return place->second;
}

unsigned HiddenCasters::sky_version() {
  if (auto const& shares = by_hour_.at(1); shares != sky_shares_) {
    sky_shares_ = shares;
    sky_views_.clear();
    ++sky_version_;
  }
  return sky_version_;
}

double HiddenCasters::sky_view(Layer const& layer) {
  sky_version();
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
  std::vector<double> all_pass(rays.size());
  all_->transmittances(rays, sky_shares_.conditions(), all_pass);
  double seen = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) seen += weights[i] * all_pass[i];
  // EnergyPlus's view factor of the sky, times its ratio of shaded to unshaded.
  place->second = 0.5 * (1.0 + layer.normal.z) * seen / whole;
  return place->second;
}

}  // namespace gpu_shading::energyplus
