#include "calculation/sky_multipliers.h"

#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {

void SkyMultipliers::renew(
    std::vector<double> shades, std::span<SurfaceId const> receivers,
    std::function<double(std::size_t patch, SurfaceId receiver)> const& sunlit_area) {
  shades_ = std::move(shades);
  known_ = true;
  weights_.assign(areas_.size(), {});
  for (auto const id : receivers) weights_[id].assign(sky_patches().size(), 0.0);
  // By patch, because all receivers are rendered for one in the same batch. A patch whose middle is
  // behind a receiver, or barely before it, has no fraction of its own.
  constexpr double min_cosine = 1e-3;
  std::vector<std::vector<bool>> faced(areas_.size(), std::vector<bool>(sky_patches().size()));
  for (std::size_t patch = 0; patch < sky_patches().size(); ++patch) {
    auto const direction = to_vector(sky_patches()[patch]);
    for (auto const id : receivers) {
      double const unshaded = glm::dot(areas_[id], direction);
      if (unshaded <= min_cosine * glm::length(areas_[id])) continue;
      faced[id][patch] = true;
      weights_[id][patch] = sunlit_area(patch, id) / unshaded;
    }
  }
  for (auto const id : receivers) {
    auto const projections = patch_projections(glm::normalize(areas_[id]));
    auto& weights = weights_[id];
    double all = 0.0;
    double lit = 0.0;
    for (std::size_t patch = 0; patch < weights.size(); ++patch) {
      weights[patch] *= projections[patch];
      if (faced[id][patch]) all += projections[patch];
      lit += weights[patch];
    }
    for (std::size_t patch = 0; patch < weights.size(); ++patch) {
      if (!faced[id][patch] && all > 0.0) weights[patch] = projections[patch] * lit / all;
    }
  }
}

std::vector<double> SkyMultipliers::at(SkyWeather const& weather) const {
  auto const radiances = perez_radiances(weather);
  std::vector<double> found;
  for (auto const& weights : weights_) {
    found.push_back(weights.empty() ? -1.0
                                    : std::inner_product(weights.begin(), weights.end(),
                                                         radiances.begin(), 0.0));
  }
  return found;
}

}  // namespace gpu_shading::energyplus
