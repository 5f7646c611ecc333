#include "reports/near_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace gpu_shading::energyplus {
namespace {

double cross(glm::dvec2 const& a, glm::dvec2 const& b) { return a.x * b.y - a.y * b.x; }

using Triangle = std::array<glm::dvec3, 3>;

// Gives the nodes that a triangle covers in plan its heights.
void set_heights(PageTerrain& terrain, Triangle const& triangle) {
  auto const& [a, b, c] = triangle;
  glm::dvec2 const first = b - a;
  glm::dvec2 const second = c - a;
  double const twice = cross(first, second);
  if (twice == 0.0) return;
  auto const node_of = [&](glm::dvec3 const& point, auto const& round) {
    auto const place = (glm::dvec2(point) - terrain.low) / terrain.step;
    auto const last = static_cast<double>(terrain.nodes - 1);
    return glm::uvec2(std::clamp(round(place.x), 0.0, last), std::clamp(round(place.y), 0.0, last));
  };
  auto const from =
      node_of(glm::min(a, glm::min(b, c)), [](double value) { return std::floor(value); });
  auto const to =
      node_of(glm::max(a, glm::max(b, c)), [](double value) { return std::ceil(value); });
  for (auto row = from.y; row <= to.y; ++row) {
    for (auto column = from.x; column <= to.x; ++column) {
      auto const point = terrain.low + glm::dvec2(column, row) * terrain.step - glm::dvec2(a);
      double const along = cross(point, second) / twice;
      double const across = cross(first, point) / twice;
      constexpr double rounding = 1e-9;
      if (along < -rounding || across < -rounding || along + across > 1.0 + rounding) continue;
      terrain.heights[row * terrain.nodes + column] =
          static_cast<float>(a.z + along * (b.z - a.z) + across * (c.z - a.z));
    }
  }
}

}  // namespace

PageTerrain terrain_in(std::span<Polygon const* const> ground, glm::dvec2 const& low,
                       glm::dvec2 const& high) {
  PageTerrain terrain;
  if (ground.empty()) return terrain;
  terrain.nodes = PageTerrain::nodes_of_side;
  terrain.low = low;
  terrain.step = (high - low) / static_cast<double>(terrain.nodes - 1);
  terrain.heights.assign(terrain.nodes * terrain.nodes, std::numeric_limits<float>::quiet_NaN());
  for (auto const* const polygon : ground) {
    auto const& ring = polygon->outline;
    for (std::size_t i = 2; i < ring.size(); ++i) {
      set_heights(terrain, {ring[0], ring[i - 1], ring[i]});
    }
  }
  if (std::ranges::all_of(terrain.heights, [](float height) { return std::isnan(height); })) {
    return {};
  }
  return terrain;
}

}  // namespace gpu_shading::energyplus
