#include "routes/opengl/queries/rendered_model.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "routes/opengl/queries/triangle_polygons.h"

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

void turn(Polygon& polygon) {
  std::reverse(polygon.outline.begin(), polygon.outline.end());
  for (auto& hole : polygon.holes) std::reverse(hole.begin(), hole.end());
}

}  // namespace

RenderedModel::RenderedModel(RendererOptions options) : options_(std::move(options)) {}

void RenderedModel::set_model(std::span<glm::vec3 const> vertices,
                              std::span<DrawnRange const> surfaces) {
  for (auto* const side : {&front_, &back_}) {
    side->renderer.reset();
    side->polygons.clear();
    side->parts.clear();
  }
  for (auto const& range : surfaces) {
    front_.polygons.push_back(polygons_of(vertices.subspan(range.first, range.count)));
    auto& turned = back_.polygons.emplace_back(front_.polygons.back());
    for (auto& polygon : turned) turn(polygon);
  }
  asked_.assign(surfaces.size(), false);
  known_.clear();
}

// What EnergyPlus asks about is turned to the sun: the other side is rarely needed.
RenderedModel::Side& RenderedModel::side_towards(glm::dvec3 const& sun, std::size_t surface) {
  auto const& polygons = front_.polygons[surface];
  bool const front = polygons.empty() || glm::dot(normal(polygons.front()), sun) >= 0.0;
  auto& side = front ? front_ : back_;
  if (!side.renderer) {
    Scene scene;
    for (auto const& of_surface : side.polygons) {
      auto& parts = side.parts.emplace_back();
      for (auto const& polygon : of_surface) {
        parts.push_back(scene.add({.name = {}, .polygon = polygon}));
      }
    }
    side.renderer.emplace(std::move(scene), options_);
  }
  return side;
}

// All surfaces that were asked about before and turn the same side to the sun are rendered at the
// first question about a direction.
void RenderedModel::render(glm::dvec3 const& towards_sun, std::size_t surface, Areas& areas) {
  auto& side = side_towards(towards_sun, surface);
  std::vector<std::size_t> surfaces;
  std::vector<SurfaceId> receivers;
  for (std::size_t i = 0; i < asked_.size(); ++i) {
    if (!asked_[i] || areas[i] || &side_towards(towards_sun, i) != &side) continue;
    surfaces.push_back(i);
    receivers.insert(receivers.end(), side.parts[i].begin(), side.parts[i].end());
  }
  auto const sunlit = side.renderer->projected_sunlit_areas(to_direction(towards_sun), receivers);
  auto next = sunlit.begin();
  for (auto const i : surfaces) {
    double sum = 0.0;
    for (std::size_t k = 0; k < side.parts[i].size(); ++k) sum += (next++)->projected_area;
    areas[i] = static_cast<float>(sum);
  }
}

double RenderedModel::sunlit_area(glm::dvec3 const& towards_sun, std::size_t surface) {
  constexpr std::size_t most_numbers = std::size_t{1} << 26U;  // 512 MiB
  if (known_.size() * asked_.size() > most_numbers) known_.clear();
  auto& areas = known_[{towards_sun.x, towards_sun.y, towards_sun.z}];
  areas.resize(asked_.size());
  if (!areas[surface]) {
    asked_[surface] = true;
    render(towards_sun, surface, areas);
  }
  return *areas[surface];
}

// Walls that the sun reaches from inside turn away from it if the window turns towards it.
std::vector<double> RenderedModel::interior_areas(glm::dvec3 const& towards_sun, std::size_t window,
                                                  std::vector<std::size_t> const& interiors) {
  auto& side = side_towards(towards_sun, window);
  std::vector<SurfaceId> surfaces;
  for (auto const interior : interiors) {
    surfaces.insert(surfaces.end(), side.parts[interior].begin(), side.parts[interior].end());
  }
  auto const sun = to_direction(towards_sun);
  std::vector<double> areas(interiors.size(), 0.0);
  for (auto const part : side.parts[window]) {
    auto const lit = side.renderer->interior_sunlit_areas(sun, part, surfaces);
    auto next = lit.begin();
    for (std::size_t i = 0; i < interiors.size(); ++i) {
      for (std::size_t k = 0; k < side.parts[interiors[i]].size(); ++k) {
        areas[i] += (next++)->projected_area;
      }
    }
  }
  keep_largest(areas);
  return areas;
}

}  // namespace gpu_shading::energyplus
