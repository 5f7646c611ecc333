#include "calculation/sky_multipliers.h"

#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "scene/sky_grid.h"

namespace gpu_shading::energyplus {

void SkyMultipliers::renew(
    std::vector<double> shades,
    std::function<std::optional<double>(std::size_t patch, SurfaceId surface)> const& sunlit_area) {
  // A patch whose middle is behind a surface, or barely before it, has no fraction of its own.
  constexpr double min_cosine = 1e-3;
  constexpr double none = -1.0;
  // By patch, because all receivers are rendered for one in the same batch.
  std::vector<std::vector<double>> fractions(areas_.size());
  for (std::size_t patch = 0; patch < sky_patches().size(); ++patch) {
    auto const direction = to_vector(sky_patches()[patch]);
    for (SurfaceId id = 0; id < areas_.size(); ++id) {
      double const unshaded = glm::dot(areas_[id], direction);
      bool const faces = unshaded > min_cosine * glm::length(areas_[id]);
      fractions[id].push_back(faces ? sunlit_area(patch, id).value_or(unshaded) / unshaded : none);
    }
  }
  weights_.clear();
  for (SurfaceId id = 0; id < areas_.size(); ++id) {
    // Nothing may be left of a wall beside its windows.
    double const area = glm::length(areas_[id]);
    auto& weights =
        weights_.emplace_back(area > 0.0 ? patch_projections(areas_[id] / area)
                                         : std::vector<double>(sky_patches().size(), 0.0));
    double all = 0.0;
    double lit = 0.0;
    for (std::size_t patch = 0; patch < weights.size(); ++patch) {
      if (fractions[id][patch] == none) continue;
      all += weights[patch];
      lit += weights[patch] * fractions[id][patch];
    }
    double const mean = all > 0.0 ? lit / all : 1.0;
    for (std::size_t patch = 0; patch < weights.size(); ++patch) {
      auto const fraction = fractions[id][patch];
      weights[patch] *= fraction == none ? mean : fraction;
    }
  }
  shades_ = std::move(shades);
}

std::vector<double> SkyMultipliers::at(SkyWeather const& weather) const {
  auto const radiances = perez_radiances(weather);
  std::vector<double> found;
  for (auto const& weights : weights_) {
    found.push_back(std::inner_product(weights.begin(), weights.end(), radiances.begin(), 0.0));
  }
  return found;
}

}  // namespace gpu_shading::energyplus
