
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

#include "files/image_file.h"
#include "gpu_shading/error.h"
#include "model/site/terrain_file.h"
#include "platform/files.h"

namespace gpu_shading::energyplus {
namespace {

MapCoordinates coordinates_of(decoding::ElevationHeader const& info) {
  if (info.epsg == 0) throw Error("does not state its coordinates: give Terrain Coordinates");
  try {
    return MapCoordinates::parse(fmt::format("EPSG:{}", info.epsg));
  } catch (Error const&) {
    throw Error(
        fmt::format("is in EPSG:{}, expected WGS84 or UTM (convert it with gdalwarp -t_srs "
                    "EPSG:4326), or Terrain Coordinates that are close enough",
                    info.epsg));
  }
}

}  // namespace

bool is_tiff(std::filesystem::path const& path) {
  require_file(path);
  std::array<char, 4> bytes{};
  std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
  std::string_view const start(bytes.data(), bytes.size());
  using std::string_view_literals::operator""sv;
  // In either byte order; + is for BigTIFF.
  return start == "II*\0"sv || start == "MM\0*"sv || start == "II+\0"sv || start == "MM\0+"sv;
}

TerrainGrid read_geotiff(std::filesystem::path const& path,
                         std::optional<MapCoordinates> const& coordinates) {
  auto [info, elevations] = read_elevations(path);
  check_terrain_size(info.columns, info.rows);
  TerrainGrid grid;
  grid.coordinates = coordinates ? *coordinates : coordinates_of(info);
  grid.columns = info.columns;
  grid.rows = info.rows;
  grid.step_x = std::abs(info.step_x);
  grid.step_y = std::abs(info.step_y);
  bool const from_east = info.step_x < 0.0;
  bool const from_north = info.step_y < 0.0;
  grid.first = {from_east ? info.x + (grid.columns - 1) * info.step_x : info.x,
                from_north ? info.y + (grid.rows - 1) * info.step_y : info.y};
  grid.elevations = std::move(elevations);
  auto const columns = static_cast<std::ptrdiff_t>(grid.columns);
  auto const row = [&](int number) { return grid.elevations.begin() + number * columns; };
  for (int low = 0, high = grid.rows - 1; from_north && low < high; ++low, --high) {
    std::swap_ranges(row(low), row(low) + columns, row(high));
  }
  for (int number = 0; from_east && number < grid.rows; ++number) {
    std::reverse(row(number), row(number) + columns);
  }
  return grid;
}

}  // namespace gpu_shading::energyplus
