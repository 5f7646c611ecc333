#pragma once

#include <optional>
#include <vector>

#include "gpu_shading/map_coordinates.h"
#include "gpu_shading/scene.h"

namespace gpu_shading {

// Elevations at the nodes of a grid along the axes of a map.
struct TerrainGrid {
  MapCoordinates coordinates;
  MapPoint first;       // the south-west node
  double step_x = 0.0;  // between nodes, in the map's units
  double step_y = 0.0;
  int columns = 0;
  int rows = 0;
  // In m, rows from the south, each from the west; NaN where the grid has no data.
  std::vector<double> elevations;

  double elevation(int column, int row) const {
    return elevations[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
  }
};

// Bilinear interpolation between the nodes; empty outside the grid and where one of the four nodes
// has no data.
std::optional<double> elevation_at(TerrainGrid const& grid, GeographicPoint const& position);

// The ground as polygons in the axes, facing up: a quadrilateral for each four nodes, or a triangle
// if one of them has no data. Polygons with a node closer to the origin of the axes than
// `clear_distance`, in plan, are left out. Throws Error if a node is not on the earth.
std::vector<Polygon> ground(TerrainGrid const& grid, LocalAxes const& axes, double clear_distance);

}  // namespace gpu_shading
