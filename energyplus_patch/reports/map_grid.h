#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gpu_shading/polygon.h"
#include "scene/flat_polygon.h"

namespace gpu_shading::energyplus {

// How many rays from receivers to the sun are traced at once.
inline constexpr std::size_t rays_in_batch = 65536;

// Axes in the Newell plane of a receiver, as somebody outside sees it: u to the right, v up. v
// points up the slope of a tilted receiver. A horizontal receiver has its axes along its longest
// edge, v within 45 degrees of north.
struct MapAxes {
  glm::dvec3 origin{0.0};  // the lower left corner of the bounding rectangle, m
  glm::dvec3 u{1.0, 0.0, 0.0};
  glm::dvec3 v{0.0, 1.0, 0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};

  glm::dvec3 place(glm::dvec2 const& point) const { return origin + point.x * u + point.y * v; }

  bool operator==(MapAxes const&) const = default;
};

// A cell of the grid, cut off at the receiver's edges and at the openings in it.
struct MapCell {
  int column = 0;  // along u, from the left
  int row = 0;     // along v, from below
  double area = 0.0;
  glm::dvec2 centre{0.0};       // of the cell; if it is cut, of its part inside
  std::vector<FlatRing> parts;  // in u and v, m: what is inside, by the odd-even rule, if it is cut
};

// A receiver cut into cells of equal size, along its bounding rectangle.
class MapGrid {
 public:
  static constexpr std::size_t max_cells = 1000000;

  // Cells are as wide and high as the spacing (m) or less, so that a whole number of them fits.
  // Throws Error if there are more than max_cells.
  MapGrid(Polygon const& polygon, double spacing);

  MapAxes const& axes() const { return axes_; }
  std::vector<FlatRing> const& rings() const { return rings_; }  // the outline, then holes
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  glm::dvec2 cell_size() const { return cell_size_; }
  std::vector<MapCell> const& cells() const { return cells_; }  // row by row, from below

  // The i-th sample point of a cell, on the receiver's plane. A few that follow each other are
  // spread evenly over the cell.
  glm::dvec3 point(MapCell const& cell, std::size_t i) const;

 private:
  void add_cell(int column, int row);

  MapAxes axes_;
  std::vector<FlatRing> rings_;
  int columns_ = 1;
  int rows_ = 1;
  glm::dvec2 cell_size_{0.0};
  std::vector<MapCell> cells_;
};

}  // namespace gpu_shading::energyplus
