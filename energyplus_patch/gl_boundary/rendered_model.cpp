#include "gl_boundary/rendered_model.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "gl_boundary/triangle_polygons.h"

namespace gpu_shading::energyplus {
namespace {

// EnergyPlus's WindowComplexManager has room for this many lit back surfaces per window.
constexpr std::size_t max_back_surfaces = 20;

// Keeps as many of the largest areas and sets the others to 0.
void keep_largest(std::vector<double>& areas) {
  if (areas.size() <= max_back_surfaces) return;
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  for (std::size_t i = max_back_surfaces; i < order.size(); ++i) areas[order[i]] = 0.0;
}

}  // namespace

RenderedModel::RenderedModel(RendererOptions options) : options_(std::move(options)) {}

void RenderedModel::set_model(std::span<glm::vec3 const> vertices,
                              std::span<DrawnRange const> surfaces) {
  Scene scene;
  parts_.assign(surfaces.size(), {});
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (auto& polygon : polygons_of(vertices.subspan(surfaces[i].first, surfaces[i].count))) {
      parts_[i].push_back(scene.add({.name = {}, .polygon = std::move(polygon)}));
    }
  }
  asked_.assign(surfaces.size(), false);
  known_.clear();
  renderer_.emplace(std::move(scene), options_);
}

// All surfaces that were asked about before are rendered at the first question about a direction.
void RenderedModel::render(SunDirection sun, Areas& areas) {
  std::vector<std::size_t> surfaces;
  std::vector<SurfaceId> receivers;
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    if (!asked_[i] || areas[i]) continue;
    surfaces.push_back(i);
    receivers.insert(receivers.end(), parts_[i].begin(), parts_[i].end());
  }
  auto const sunlit = renderer_->projected_sunlit_areas(sun, receivers);
  auto next = sunlit.begin();
  for (auto const surface : surfaces) {
    double sum = 0.0;
    for (std::size_t k = 0; k < parts_[surface].size(); ++k) sum += (next++)->projected_area;
    areas[surface] = static_cast<float>(sum);
  }
}

double RenderedModel::sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) {
  constexpr std::size_t most_numbers = std::size_t{1} << 26U;  // 512 MiB
  if (known_.size() * asked_.size() > most_numbers) known_.clear();
  auto& areas = known_[{towards_sun.x, towards_sun.y, towards_sun.z}];
  areas.resize(asked_.size());
  if (!areas[surface]) {
    asked_[surface] = true;
    render(to_direction(towards_sun), areas);
  }
  return *areas[surface];
}

std::vector<double> RenderedModel::interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                                  std::vector<std::size_t> const& interiors) {
  std::vector<SurfaceId> surfaces;
  for (auto const interior : interiors) {
    surfaces.insert(surfaces.end(), parts_[interior].begin(), parts_[interior].end());
  }
  auto const sun = to_direction(towards_sun);
  std::vector<double> areas(interiors.size(), 0.0);
  for (auto const part : parts_[window]) {
    auto const lit = renderer_->interior_sunlit_areas(sun, part, surfaces);
    auto next = lit.begin();
    for (std::size_t i = 0; i < interiors.size(); ++i) {
      for (std::size_t k = 0; k < parts_[interiors[i]].size(); ++k) {
        areas[i] += (next++)->projected_area;
      }
    }
  }
  keep_largest(areas);
  return areas;
}

}  // namespace gpu_shading::energyplus
