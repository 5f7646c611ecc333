#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gpu_shading/polygon.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {

// What is mapped of a session in EnergyPlus, and the file that it is written to.
struct MapRequest {
  std::string receivers;  // a pattern of names; empty: all that EnergyPlus shades
  double spacing = 0.0;   // of the cells, m
  int rays_per_cell = 0;  // at each time
  RunTimes run;           // the times with the sun up, with the beam and the schedules
  std::filesystem::path file;
  int progress = -1;  // the file descriptor for progress; none if negative

  bool operator==(MapRequest const&) const = default;
};

// What a cell gets in a period.
struct MapValue {
  double hours = 0.0;   // h, each weighted by what passes the shades
  double energy = 0.0;  // beam solar radiation, kWh/m2
};

// The map of one receiver: MapGrid(polygon, spacing) and the values of its cells.
struct ReceiverMap {
  std::string name;
  Polygon polygon;
  std::vector<MapValue> values;
};

// Maps on their way from the process that runs EnergyPlus to the one that draws them. Throw Error
// if the file cannot be read or written.
void write_maps(std::filesystem::path const& file, std::vector<ReceiverMap> const& maps);
std::vector<ReceiverMap> read_maps(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
