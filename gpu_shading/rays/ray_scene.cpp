#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "filters/transmission.h"
#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "platform/parallel.h"
#include "rays/ray_bodies.h"
#include "rays/ray_shapes.h"
#include "rays/ray_tree.h"
#include "scene/casters.h"

namespace gpu_shading {
namespace {

std::vector<SurfaceId> casters_of(Scene const& scene, RayOptions const& options) {
  std::vector<SurfaceId> casters;
  if (options.casters) {
    casters = *options.casters;
    std::sort(casters.begin(), casters.end());
    casters.erase(std::unique(casters.begin(), casters.end()), casters.end());
    if (!casters.empty() && casters.back() >= scene.size()) {
      throw Error(fmt::format("there is no surface {} for rays to meet: the scene has {}",
                              casters.back(), scene.size()));
    }
    return casters;
  }
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    if (scene[id].casting != Casting::never) casters.push_back(id);
  }
  return casters;
}

template <typename Result, typename Answer>
void for_each_ray(std::span<Ray const> rays, std::span<Result> results, Answer const& answer) {
  if (results.size() != rays.size()) {
    throw Error(
        fmt::format("{} results for {} rays, expected as many", results.size(), rays.size()));
  }
  // Starting a task takes as long as several rays.
  constexpr std::size_t block = 256;
  for_each_index((rays.size() + block - 1) / block, [&](std::size_t number) {
    std::size_t const end = std::min(rays.size(), (number + 1) * block);
    for (std::size_t i = number * block; i < end; ++i) results[i] = answer(rays[i]);
  });
}

}  // namespace

class RayScene::Implementation {
 public:
  Implementation(Scene const& scene, RayOptions const& options)
      : Implementation(scene, options, casters_of(scene, options)) {}

  double transmittance(Ray const& ray, RayConditions const& conditions) const {
    double product = 1.0;
    search(ray, conditions, [&](double, SurfaceId, double transmittance) {
      product *= transmittance;
      return product > 0.0 ? std::numeric_limits<double>::infinity() : -1.0;
    });
    return product;
  }

  std::optional<RayHit> nearest_opaque(Ray const& ray, RayConditions const& conditions) const {
    std::optional<RayHit> nearest;
    search(ray, conditions, [&](double distance, SurfaceId surface, double transmittance) {
      if (transmittance > 0.0) return std::numeric_limits<double>::infinity();
      // Of surfaces in one place, the first in the scene's order.
      if (!nearest || distance < nearest->distance || surface < nearest->surface) {
        nearest = RayHit{surface, distance};
      }
      return distance;
    });
    return nearest;
  }

  std::vector<RayLayer> layers(Ray const& ray, RayConditions const& conditions) const {
    std::vector<RayLayer> layers;
    search(ray, conditions, [&](double distance, SurfaceId surface, double transmittance) {
      layers.push_back({surface, distance, transmittance});
      return transmittance > 0.0 ? std::numeric_limits<double>::infinity() : distance;
    });
    std::sort(layers.begin(), layers.end(), [](RayLayer const& a, RayLayer const& b) {
      return std::pair(a.distance, a.surface) < std::pair(b.distance, b.surface);
    });
    auto const opaque = std::find_if(layers.begin(), layers.end(), [](RayLayer const& layer) {
      return layer.transmittance <= 0.0;
    });
    if (opaque != layers.end()) layers.erase(std::next(opaque), layers.end());
    return layers;
  }

 private:
  // For surfaces that stop rays from both sides.
  static constexpr glm::dvec3 no_face{0.0};

  Implementation(Scene const& scene, RayOptions const& options, std::span<SurfaceId const> casters)
      : transmission_(scene),
        rule_(scene.rule()),
        lit_faces_(scene.size(), no_face),
        bodies_(transmission_, casters, options) {
    for (SurfaceId const id : casters) {
      Surface const& surface = scene[id];
      if (transmission_.is_flat(id)) shapes_.add(id, surface.polygon);
      if (options.faces == RayFaces::as_casting && surface.casting == Casting::turned_away) {
        lit_faces_[id] = normal(surface.polygon);
      }
    }
    shapes_.make_tree();
  }

  // Calls met(distance, surface, transmittance) for what the ray meets, in any order; it returns
  // the distance up to which more is wanted.
  template <typename Met>
  void search(Ray const& ray, RayConditions const& conditions, Met const& met) const {
    if (conditions.receiver && *conditions.receiver >= lit_faces_.size()) {
      throw Error(fmt::format("there is no surface {} for a ray to ask for: the scene has {}",
                              *conditions.receiver, lit_faces_.size()));
    }
    RayPath const path(ray);
    double limit = path.length;
    auto const skips = [&](SurfaceId surface) {
      return surface == ray.from || !counts(surface, path, conditions);
    };
    shapes_.search(path, limit, [&](SurfaceId surface, double distance) {
      if (skips(surface)) return;
      limit = std::min(limit, met(distance, surface, passed(surface, path, conditions)));
    });
    bodies_.search(path, limit, conditions.deployments, skips,
                   [&](SurfaceId surface, double distance, double transmittance) {
                     limit = std::min(limit, met(distance, surface, transmittance));
                   });
  }

  bool counts(SurfaceId surface, RayPath const& path, RayConditions const& conditions) const {
    if (glm::dot(lit_faces_[surface], path.direction) > in_the_sun) return false;
    if (std::find(conditions.excluded.begin(), conditions.excluded.end(), surface) !=
        conditions.excluded.end()) {
      return false;
    }
    if (!conditions.receiver) return true;
    return *conditions.receiver != surface && rule_(*conditions.receiver, surface);
  }

  double passed(SurfaceId surface, RayPath const& path, RayConditions const& conditions) const {
    double transmittance = transmission_.transmittance(surface, path.direction);
    if (int const schedule = transmission_.schedule(surface); schedule != Shade::unscheduled) {
      int const index = transmission_.schedules()[static_cast<std::size_t>(schedule)];
      transmittance *= at_or_one(conditions.factors, index);
    }
    return transmittance;
  }

  Transmission transmission_;
  ShadingRule rule_;
  std::vector<glm::dvec3> lit_faces_;  // by surface, the normal of a face that stops no rays
  RayShapes shapes_;
  RayBodies bodies_;
};

RayScene::RayScene(Scene const& scene, RayOptions const& options)
    : implementation_(std::make_unique<Implementation>(scene, options)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

double RayScene::transmittance(Ray const& ray, RayConditions const& conditions) const {
  return implementation_->transmittance(ray, conditions);
}

std::optional<RayHit> RayScene::nearest_opaque(Ray const& ray,
                                               RayConditions const& conditions) const {
  return implementation_->nearest_opaque(ray, conditions);
}

std::vector<RayLayer> RayScene::layers(Ray const& ray, RayConditions const& conditions) const {
  return implementation_->layers(ray, conditions);
}

void RayScene::transmittances(std::span<Ray const> rays, RayConditions const& conditions,
                              std::span<double> results) const {
  for_each_ray(rays, results, [&](Ray const& ray) { return transmittance(ray, conditions); });
}

void RayScene::layers(std::span<Ray const> rays, RayConditions const& conditions,
                      std::span<std::vector<RayLayer>> results) const {
  for_each_ray(rays, results, [&](Ray const& ray) { return layers(ray, conditions); });
}

}  // namespace gpu_shading
