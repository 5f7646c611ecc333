#pragma once

#include <string>
#include <vector>

#include "reports/map_grid.h"
#include "tasks/task.h"

namespace gpu_shading::energyplus {

// What the scales of a picture end at.
struct MapScales {
  double hours = 1.0;   // h
  double energy = 1.0;  // kWh/m2
};

// The least multiples of a round step that hold the largest values.
MapScales scales_for(MapValue const& most);

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
