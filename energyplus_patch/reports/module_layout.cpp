#include "reports/module_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// Vertices come in single precision: a module may reach this far over an edge, m.
constexpr double tolerance = 1e-4;

glm::dvec2 module_size(PvModules const& spec) {
  return spec.orientation == PvModules::Orientation::portrait ? glm::dvec2(spec.width, spec.length)
                                                              : glm::dvec2(spec.length, spec.width);
}

int count_along(double room, double size, double gap) {
  double const count = std::floor((room + gap + tolerance) / (size + gap));
  return static_cast<int>(std::clamp(count, 0.0, 1e6));
}

// Whether a segment has a part inside a box (Liang and Barsky 1984).
bool enters(glm::dvec2 const& a, glm::dvec2 const& b, FlatBox const& box) {
  double from = 0.0;
  double to = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    double const step = b[axis] - a[axis];
    if (step == 0.0) {
      if (a[axis] <= box.low[axis] || a[axis] >= box.high[axis]) return false;
      continue;
    }
    double const one = (box.low[axis] - a[axis]) / step;
    double const other = (box.high[axis] - a[axis]) / step;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from < to;
}

}  // namespace

ModuleLayout::ModuleLayout(PvModules const& modules, std::string surface, Polygon const& polygon)
    : spec_(modules), surface_(std::move(surface)) {
  // One cell, for the axes and the bounding rectangle.
  constexpr double all = 1e9;
  MapGrid const grid(polygon, all);
  axes_ = grid.axes();
  rings_ = grid.rings();
  auto const room = grid.cell_size();
  auto const size = module_size(spec_);
  int const columns = spec_.columns.value_or(count_along(room.x, size.x, spec_.gap));
  int const rows = spec_.rows.value_or(count_along(room.y, size.y, spec_.gap));
  if (static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) > max_modules) {
    throw Error(fmt::format("{}: {} x {} modules on {}, expected at most {}", spec_.where, columns,
                            rows, surface_, max_modules));
  }
  auto const taken = glm::dvec2(columns, rows) * (size + spec_.gap) - spec_.gap;
  auto const start = (room - taken) / 2.0;
  bool const by_row = spec_.direction == PvModules::Direction::rows;
  for (int i = 0; i < columns * rows; ++i) {
    int const column = by_row ? i % columns : i / rows;
    int const row = by_row ? i / columns : i % rows;
    auto const low = start + glm::dvec2(column, row) * (size + spec_.gap);
    FlatBox const box{low, low + size};
    if (is_on_surface(box)) modules_.push_back({column, row, 0, box});
  }
  if (modules_.empty()) {
    throw Error(fmt::format("{}: no module of {} m x {} m fits on {}, {:.4g} m x {:.4g} m",
                            spec_.where, size.x, size.y, surface_, room.x, room.y));
  }
  auto const length =
      spec_.string_length ? static_cast<std::size_t>(*spec_.string_length) : modules_.size();
  for (std::size_t i = 0; i < modules_.size(); ++i) {
    modules_[i].string = static_cast<int>(i / length);
  }
}

bool ModuleLayout::is_on_surface(FlatBox const& box) const {
  FlatBox const within{box.low + tolerance, box.high - tolerance};
  if (!is_inside(rings_, (box.low + box.high) / 2.0)) return false;
  for (auto const& ring : rings_) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (enters(ring[i], ring[(i + 1) % ring.size()], within)) return false;
    }
  }
  return true;
}

FlatBox ModuleLayout::cell(PlacedModule const& module, std::size_t number) const {
  auto const columns = static_cast<std::size_t>(spec_.cell_columns);
  auto const row = number / columns;
  glm::dvec2 place{static_cast<double>(number % columns), static_cast<double>(row)};
  glm::dvec2 counts{spec_.cell_columns, spec_.cell_rows};
  if (spec_.orientation == PvModules::Orientation::landscape) {
    std::swap(place.x, place.y);
    std::swap(counts.x, counts.y);
  }
  auto const low = module.box.low + spec_.frame;
  auto const size = (module.box.high - module.box.low - 2.0 * spec_.frame) / counts;
  return {low + place * size, low + (place + 1.0) * size};
}

int ModuleLayout::diode(std::size_t cell) const {
  auto const column = static_cast<int>(cell % static_cast<std::size_t>(spec_.cell_columns));
  return column / (spec_.cell_columns / spec_.diodes);
}

Polygon ModuleLayout::polygon(FlatBox const& box) const {
  auto const lift = ray_lift * axes_.normal;
  auto const at = [&](double u, double v) { return axes_.place({u, v}) + lift; };
  return {{at(box.low.x, box.low.y), at(box.high.x, box.low.y), at(box.high.x, box.high.y),
           at(box.low.x, box.high.y)},
          {}};
}

FlatBox ModuleLayout::bounds() const {
  auto bounds = modules_.front().box;
  for (auto const& module : modules_) {
    bounds.low = glm::min(bounds.low, module.box.low);
    bounds.high = glm::max(bounds.high, module.box.high);
  }
  return bounds;
}

}  // namespace gpu_shading::energyplus
