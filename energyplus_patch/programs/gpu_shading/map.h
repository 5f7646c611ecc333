#pragma once

#include <filesystem>
#include <string>

#include "programs/gpu_shading/model_run.h"

namespace gpu_shading::energyplus {

struct MapOrder {
  std::string from;       // "MM-DD"; empty: 1 January
  std::string to;         // "MM-DD", the last day; empty: 31 December
  std::string receivers;  // a pattern of names; empty: all that EnergyPlus shades
  double spacing = 0.25;  // m
  int rays_per_cell = 4;
  bool common_scale = false;  // of the pictures; otherwise each has its own
  std::filesystem::path folder;
};

// Traces and writes maps of sunlit hours and beam energy: for each receiver a picture, a table and
// an array, and for all of them maps.csv, and maps.json about the run. maps.json also lists the
// files with their hashes: only files that it lists and that are unchanged are replaced or, if they
// belong to no map any more, deleted. Throws Error.
void draw_maps(ModelRun const& run, MapOrder const& order);

}  // namespace gpu_shading::energyplus
