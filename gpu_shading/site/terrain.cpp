#include "gpu_shading/terrain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gpu_shading {
namespace {

// A row of nodes in the axes; empty where the grid has no data.
std::vector<std::optional<glm::dvec3>> row_of(TerrainGrid const& grid, int row,
                                              LocalAxes const& axes) {
  std::vector<std::optional<glm::dvec3>> nodes(static_cast<std::size_t>(grid.columns));
  for (int column = 0; column < grid.columns; ++column) {
    double const elevation = grid.elevation(column, row);
    if (!std::isfinite(elevation)) continue;
    MapPoint const position{grid.first.x + grid.step_x * column, grid.first.y + grid.step_y * row};
    nodes[static_cast<std::size_t>(column)] =
        axes.to_local(grid.coordinates.to_geographic(position, elevation));
  }
  return nodes;
}

}  // namespace

std::optional<double> elevation_at(TerrainGrid const& grid, GeographicPoint const& position) {
  double const middle = grid.first.x + 0.5 * grid.step_x * (grid.columns - 1);
  auto const point = grid.coordinates.from_geographic(position, middle);
  // A position on the edge is on the grid, whatever the last digit.
  constexpr double rounding = 1e-6;
  auto const along = [&](double value, double first, double step,
                         int count) -> std::optional<std::pair<int, double>> {
    double const at = (value - first) / step;
    double const last = count - 1;
    // Negated so that a NaN is outside.
    if (!(at >= -rounding && at <= last + rounding) || count < 2) return std::nullopt;
    auto const cell = std::clamp(static_cast<int>(at), 0, count - 2);
    return std::pair(cell, std::clamp(at - cell, 0.0, 1.0));
  };
  auto const x = along(point.x, grid.first.x, grid.step_x, grid.columns);
  auto const y = along(point.y, grid.first.y, grid.step_y, grid.rows);
  if (!x || !y) return std::nullopt;
  auto const [column, u] = *x;
  auto const [row, v] = *y;
  double const found =
      (1.0 - v) * ((1.0 - u) * grid.elevation(column, row) + u * grid.elevation(column + 1, row)) +
      v * ((1.0 - u) * grid.elevation(column, row + 1) + u * grid.elevation(column + 1, row + 1));
  return std::isfinite(found) ? std::optional(found) : std::nullopt;
}

std::vector<Polygon> ground(TerrainGrid const& grid, LocalAxes const& axes, double clear_distance) {
  std::vector<Polygon> polygons;
  if (grid.rows < 2 || grid.columns < 2) return polygons;
  polygons.reserve(static_cast<std::size_t>(grid.rows - 1) *
                   static_cast<std::size_t>(grid.columns - 1));
  auto const is_clear = [&](Ring const& ring) {
    return std::ranges::any_of(
        ring, [&](glm::dvec3 const& node) { return std::hypot(node.x, node.y) < clear_distance; });
  };
  auto south = row_of(grid, 0, axes);
  for (int row = 1; row < grid.rows; ++row) {
    auto north = row_of(grid, row, axes);
    for (std::size_t i = 0; i + 1 < south.size(); ++i) {
      Ring ring;
      for (auto const& node : {south[i], south[i + 1], north[i + 1], north[i]}) {
        if (node) ring.push_back(*node);
      }
      if (ring.size() >= 3 && !is_clear(ring)) polygons.push_back({std::move(ring), {}});
    }
    south = std::move(north);
  }
  return polygons;
}

}  // namespace gpu_shading
