#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "reports/map_grid.h"
#include "tasks/task.h"

// The files of `gpu_shading map`.
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
  MapValue mean;     // of the area
  MapValue largest;  // of a cell
};

MapSummary summarise(MapGrid const& grid, std::vector<MapValue> const& values);

// A row for each cell: its column and row, its centre in world axes (x east, y north, z up) and in
// the receiver's own (u, v), its area and its values.
void write_cells(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& csv);

// The start of a file in NumPy's format 1.0.
void write_npy_header(std::string_view type, std::vector<std::size_t> const& shape,
                      std::ostream& npy);

// NumPy's format 1.0: single precision of shape (2, rows, columns), first hours, then kWh/m2; the
// lowest row first; nan where the receiver has no cell.
void write_array(MapGrid const& grid, std::vector<MapValue> const& values, std::ostream& npy);

void write_summaries(std::vector<MapSummary> const& summaries, std::ostream& csv);

// The ends of a picture's scales.
struct MapScales {
  double hours = 1.0;   // h
  double energy = 1.0;  // kWh/m2
};

// The least multiples of a round step that hold the largest values.
MapScales scales_for(MapValue const& largest);

// "180 degrees (S)": an azimuth clockwise from true north, in degrees.
std::string describe_azimuth(double azimuth);

struct MapHeading {
  std::string title;
  std::vector<std::string> lines;
};

// The map of a receiver as a .png: sunlit hours and beam energy by cell, seen from outside, each
// with a scale, lengths in metres and the points of the compass. Throws Error.
std::string draw_map(std::string const& name, MapHeading const& heading, MapGrid const& grid,
                     std::vector<MapValue> const& values, MapScales const& scales);

}  // namespace gpu_shading::energyplus
