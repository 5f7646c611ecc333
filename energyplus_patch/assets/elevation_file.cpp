#include "assets/elevation_file.h"

#include <array>

#include "assets/plugin.h"
#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {

gpu_shading_elevation_info probe_elevations(std::filesystem::path const& path) {
  static auto const probe = reinterpret_cast<decltype(&gpu_shading_probe_elevations)>(
      plugin_function(gpu_shading_image_library, "GeoTIFF", "gpu_shading_probe_elevations"));
  gpu_shading_elevation_info info{};
  std::array<char, 512> message{};
  if (probe(path.c_str(), &info, message.data(), message.size()) != 0) throw Error(message.data());
  return info;
}

std::vector<double> read_elevations(std::filesystem::path const& path,
                                    gpu_shading_elevation_info const& info) {
  static auto const read = reinterpret_cast<decltype(&gpu_shading_read_elevations)>(
      plugin_function(gpu_shading_image_library, "GeoTIFF", "gpu_shading_read_elevations"));
  std::vector<double> elevations(static_cast<std::size_t>(info.columns) *
                                 static_cast<std::size_t>(info.rows));
  std::array<char, 512> message{};
  if (read(path.c_str(), info.columns, info.rows, elevations.data(), message.data(),
           message.size()) != 0) {
    throw Error(message.data());
  }
  return elevations;
}

}  // namespace gpu_shading::energyplus
