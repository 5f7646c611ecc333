#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reports/map_grid.h"
#include "tasks/task.h"

namespace gpu_shading::energyplus {

// A receiver in the list of maps.
struct MapSummary {
  std::string receiver;
  std::string stem;         // of its files
  double azimuth = 0.0;     // of the normal, degrees clockwise from true north
  double tilt = 0.0;        // degrees; 0: faces up, 90: wall
  double area = 0.0;        // m2
  double cell_width = 0.0;  // m
  double cell_height = 0.0;
  std::size_t cells = 0;
  MapValue mean;  // of the area
  MapValue most;  // of a cell
};

MapSummary summarise(MapGrid const& grid, std::vector<MapValue> const& values);

// A row for each cell: its column and row, its centre in world axes (x east, y north, z up) and in
// the receiver's own (u, v), its area and its values.
void write_cells(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& csv);

// NumPy's format 1.0: single precision of shape (2, rows, columns), first hours, then kWh/m2; the
// lowest row first; nan where the receiver has no cell.
void write_array(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& npy);

void write_summaries(std::vector<MapSummary> const& summaries, std::ostream& csv);

}  // namespace gpu_shading::energyplus
