#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gpu_shading::energyplus {

// A folder that `gpu_shading map` wrote.
struct MapFolder {
  struct Row {
    std::string receiver;  // as a field of CSV, csv_field()
    std::string stem;      // of its files
    double mean_hours = 0.0;
    double mean_energy = 0.0;  // kWh/m2
  };

  std::string from;  // the first and the last day, MM-DD
  std::string to;
  std::vector<Row> rows;
};

// Nothing if the folder has no maps. Throws Error, naming the file, if maps.json or maps.csv is not
// as `gpu_shading map` writes it.
std::optional<MapFolder> read_map_folder(std::filesystem::path const& folder);

// The values of one map. `hours` and `energy` (kWh/m2): row by row, the lowest first, not a number
// where the receiver has no cell.
struct MapArray {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> hours;
  std::vector<float> energy;
};

// Throws Error, naming the file, unless it is an array as `gpu_shading map` writes it, with at most
// MapGrid::max_cells cells and no negative or infinite values.
MapArray read_map_array(std::filesystem::path const& file);

}  // namespace gpu_shading::energyplus
