#include "reports/map_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// The unit vector up the slope; along the longest edge or across it, towards north, if the surface
// is horizontal.
glm::dvec3 up_the_map(Polygon const& polygon, glm::dvec3 const& normal) {
  constexpr glm::dvec3 zenith{0.0, 0.0, 1.0};
  constexpr glm::dvec3 north{0.0, 1.0, 0.0};
  constexpr double nearly_horizontal = 1e-3;  // sine of the tilt
  auto const slope = zenith - normal.z * normal;
  if (glm::length(slope) > nearly_horizontal) return glm::normalize(slope);
  auto edge = longest_edge(polygon.outline);
  edge = glm::normalize(edge - glm::dot(edge, normal) * normal);
  auto const across = glm::cross(normal, edge);
  auto const nearest =
      std::abs(glm::dot(edge, north)) >= std::abs(glm::dot(across, north)) ? edge : across;
  return glm::dot(nearest, north) < 0.0 ? -nearest : nearest;
}

// The number of cells along a side.
int count_of(double length, double spacing) {
  constexpr double rounding = 1e-6;  // single precision must not add a cell
  constexpr double max_count = static_cast<double>(MapGrid::max_cells) + 1.0;
  return static_cast<int>(std::clamp(std::ceil(length / spacing - rounding), 1.0, max_count));
}

// Keeps what lies on the positive side of a line along an axis (Sutherland and Hodgman 1974). Areas
// stay right for rings that are not convex, because edges along the line cancel.
FlatRing clip(FlatRing const& ring, int axis, double line, double side) {
  FlatRing kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& a = ring[i];
    auto const& b = ring[(i + 1) % ring.size()];
    double const before = side * (a[axis] - line);
    double const after = side * (b[axis] - line);
    if (before >= 0.0) kept.push_back(a);
    if ((before >= 0.0) != (after >= 0.0))
      kept.push_back(glm::mix(a, b, before / (before - after)));
  }
  return kept;
}

double area_of(FlatRing const& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    auto const& a = ring[i];
    auto const& b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2.0;
}

// The i-th point inside the parts of a cell; `other` if they are too small for the points to meet.
glm::dvec2 point_inside(std::vector<FlatRing> const& parts, glm::dvec2 const& low,
                        glm::dvec2 const& size, std::size_t i, glm::dvec2 const& other) {
  constexpr std::size_t tries = 64;
  constexpr std::size_t stride = 1000003;
  for (std::size_t attempt = 0; attempt < tries; ++attempt) {
    auto const point = low + spread_point(i + attempt * stride) * size;
    if (is_inside(parts, point)) return point;
  }
  return other;
}

// The mean of points inside; a corner if they meet none.
glm::dvec2 centre_of(std::vector<FlatRing> const& parts, glm::dvec2 const& low,
                     glm::dvec2 const& size) {
  constexpr std::size_t points = 64;
  auto const corner = parts.front().front();
  glm::dvec2 sum{0.0};
  for (std::size_t i = 0; i < points; ++i) sum += point_inside(parts, low, size, i, corner);
  return sum / static_cast<double>(points);
}

}  // namespace

MapGrid::MapGrid(Polygon const& polygon, double spacing) {
  axes_.normal = normal(polygon);
  axes_.v = up_the_map(polygon, axes_.normal);
  axes_.u = glm::cross(axes_.v, axes_.normal);
  auto const start = polygon.outline.front();
  auto const project = [&](Ring const& ring) {
    FlatRing flat;
    for (auto const& point : ring) {
      flat.emplace_back(glm::dot(point - start, axes_.u), glm::dot(point - start, axes_.v));
    }
    return flat;
  };
  rings_.push_back(project(polygon.outline));
  for (auto const& hole : polygon.holes) rings_.push_back(project(hole));
  glm::dvec2 low = rings_.front().front();
  glm::dvec2 high = low;
  for (auto const& point : rings_.front()) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  for (auto& ring : rings_) {
    for (auto& point : ring) point -= low;
  }
  axes_.origin = start + low.x * axes_.u + low.y * axes_.v;
  columns_ = count_of(high.x - low.x, spacing);
  rows_ = count_of(high.y - low.y, spacing);
  if (static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) > max_cells) {
    throw Error(fmt::format("a receiver of {:.6g} m x {:.6g} m has more than {} cells of {} m",
                            high.x - low.x, high.y - low.y, max_cells, spacing));
  }
  cell_size_ = (high - low) / glm::dvec2(columns_, rows_);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) add_cell(column, row);
  }
}

void MapGrid::add_cell(int column, int row) {
  auto const low = glm::dvec2(column, row) * cell_size_;
  auto const high = low + cell_size_;
  double const whole = cell_size_.x * cell_size_.y;
  std::vector<FlatRing> parts;
  double area = 0.0;
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    auto part = rings_[i];
    for (int axis = 0; axis < 2; ++axis) {
      part = clip(clip(part, axis, low[axis], 1.0), axis, high[axis], -1.0);
    }
    area += (i == 0 ? 1.0 : -1.0) * area_of(part);
    parts.push_back(std::move(part));
  }
  // Less than that is rounding.
  constexpr double rounding = 1e-6;
  if (area <= rounding * whole) return;
  MapCell cell{column, row, area, (low + high) / 2.0, {}};
  if (area < (1.0 - rounding) * whole) {
    cell.centre = centre_of(parts, low, cell_size_);
    cell.parts = std::move(parts);
  }
  cells_.push_back(std::move(cell));
}

glm::dvec3 MapGrid::point(MapCell const& cell, std::size_t i) const {
  auto const low = glm::dvec2(cell.column, cell.row) * cell_size_;
  if (cell.parts.empty()) return axes_.place(low + spread_point(i) * cell_size_);
  return axes_.place(point_inside(cell.parts, low, cell_size_, i, cell.centre));
}

}  // namespace gpu_shading::energyplus
