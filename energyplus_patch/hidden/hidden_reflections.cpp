#include "hidden/hidden_reflections.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {
namespace {

// Sky views differ from EnergyPlus's by 0.3 % with them, and by 4 % with 16.
constexpr std::size_t samples = 256;

}  // namespace

HiddenReflections::HiddenReflections(SceneAssembly const& scene)
    : casters_(scene, ShadeOptics::Radiation::solar, samples) {}

void HiddenReflections::set_rays(std::vector<ReflectionRay> rays) {
  rays_ = std::move(rays);
  paths_.clear();
  moment_.reset();
}

double HiddenReflections::transmittance(Ray const& ray, int hour) {
  trace(hour);
  return casters_.transmittance(ray);
}

// Reads the schedules of an hour, and follows the rays again if they have changed.
void HiddenReflections::trace(int hour) {
  if (moment_ == hour) return;
  moment_ = hour;
  bool const changed = casters_.set_hour(hour);
  if (paths_.size() == rays_.size() && !changed) return;
  std::vector<Ray> rays;
  for (auto const& ray : rays_) rays.push_back({ray.origin, ray.direction, ray.distance});
  paths_ = casters_.paths(rays);
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
  auto const hidden_pass = casters_.transmittances(to_the_sun);
  std::vector<std::size_t> dimmed;
  std::vector<Ray> from_dimmed;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    auto& kept = shares_[i].kept;
    kept = paths_[i].passed * hidden_pass[i];
    if (rays_[i].meets != ReflectionRay::Meets::ground || kept >= 1.0) continue;
    if (kept > 0.0) {
      dimmed.push_back(i);
      from_dimmed.push_back(to_the_sun[i]);
    }
    kept = 0.0;
  }
  auto const all_pass = casters_.transmittances_of_all(from_dimmed);
  for (std::size_t i = 0; i < dimmed.size(); ++i) {
    shares_[dimmed[i]].ground = paths_[dimmed[i]].passed * all_pass[i];
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
    for (auto const& layer : paths_[i].layers) {
      double const cosine = glm::dot(layer.normal, sun.direction);
      if (cosine <= 0.0) continue;
      facing.push_back({i, &layer, cosine});
      to_the_sun.push_back({layer.at, sun.direction, Ray{}.length, layer.surface});
    }
  }
  auto const reached = casters_.transmittances_of_all(to_the_sun);
  for (std::size_t i = 0; i < facing.size(); ++i) {
    auto const& [ray, layer, cosine] = facing[i];
    if (reached[i] > 0.0 && lit(*layer, sun.at_first_timestep)) {
      shares_[ray].shades += cosine * layer->reflectance * reached[i];
    }
  }
}

std::vector<ReflectedShare> const& HiddenReflections::sky() {
  trace(1);
  shares_.assign(rays_.size(), {});
  for (std::size_t i = 0; i < rays_.size(); ++i) shares_[i] = sky_share(rays_[i], paths_[i]);
  return shares_;
}

ReflectedShare HiddenReflections::sky_share(ReflectionRay const& ray, RayPath const& path) {
  ReflectedShare share;
  share.kept = path.passed;
  for (auto const& layer : path.layers)
    share.shades += layer.reflectance * casters_.sky_view(layer);
  if (ray.meets != ReflectionRay::Meets::ground || path.passed <= 0.0) return share;

  std::vector<Ray> upward;
  for (auto const& patch : sky_patches_from_ground()) upward.push_back({ray.hit, patch.direction});
  auto const hidden_pass = casters_.transmittances(upward);
  bool const free = std::ranges::all_of(hidden_pass, [](double p) { return p >= 1.0; });
  if (free && path.passed >= 1.0) return share;
  auto const all_pass = casters_.transmittances_of_all(upward);
  for (std::size_t i = 0; i < upward.size(); ++i) {
    share.ground += path.passed * sky_patches_from_ground()[i].share * all_pass[i];
  }
  share.kept = 0.0;
  return share;
}

// Whether at least a hundredth of a side is in the sun.
bool HiddenReflections::lit(Layer const& layer, std::optional<glm::dvec3> const& to_sun) {
  if (!to_sun || glm::dot(layer.normal, *to_sun) <= 0.0) return false;
  auto const [place, added] = lit_.try_emplace(casters_.side_of(layer), false);
  if (!added) return place->second;
  auto const& points = casters_.samples(layer.surface);
  double wanted = 0.01 * static_cast<double>(points.size());
  for (auto const& point : points) {
    wanted -= casters_.transmittance_of_all({point, *to_sun, Ray{}.length, layer.surface});
    if (wanted <= 0.0) return place->second = true;
  }
  return false;
}

}  // namespace gpu_shading::energyplus
