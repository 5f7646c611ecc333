#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "gpu_shading/rays.h"
#include "gpu_shading/sun_direction.h"
#include "reports/map_file.h"
#include "reports/map_grid.h"

namespace gpu_shading::energyplus {

// A time at which the sun is up.
struct MapTime {
  SunDirection sun;
  double beam = 0.0;                // direct normal irradiance, W/m2
  std::vector<double> factors;      // by BeamFilter::schedule
  std::vector<double> deployments;  // by PerforatedSheet::deployment
};

struct MapSettings {
  double hours_per_step = 1.0;
  std::size_t rays_per_cell = 4;  // at each time
};

// The values of each cell of a receiver's grid, in order. A cell's value is the mean over rays
// towards the sun from a few of its points, which take turns from time to time. `done` is called
// with the number of times that are complete.
std::vector<MapValue> trace_map(RayScene const& rays, SurfaceId receiver, MapGrid const& grid,
                                std::vector<MapTime> const& times, MapSettings const& settings,
                                std::function<void(std::size_t)> const& done);

}  // namespace gpu_shading::energyplus
