#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "gpu_shading/sun_direction.h"
#include "platform/progress.h"
#include "platform/text.h"
#include "reports/map_grid.h"
#include "reports/remarks.h"
#include "runs/run_times.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

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

bool alike(MapTime const& a, MapTime const& b) {
  return a.factors == b.factors && a.deployments == b.deployments;
}

// Neighbouring cells begin at other points, so that the edge of a shadow along a row or a column
// does not pass all of them in one place.
std::size_t turn_of(MapCell const& cell) {
  constexpr std::size_t from_row_to_row = 37;
  return static_cast<std::size_t>(cell.column) +
         from_row_to_row * static_cast<std::size_t>(cell.row);
}

// Rays of successive times with the same conditions, traced together.
class RayBatch {
 public:
  RayBatch(RayScene const& rays, SurfaceId receiver, MapGrid const& grid,
           MapSettings const& settings)
      : rays_(rays), receiver_(receiver), grid_(grid), settings_(settings) {
    values_.resize(grid.cells().size());
  }

  void add(MapTime const& time, std::size_t number) {
    auto const sun = to_vector(time.sun);
    double const cosine = glm::dot(sun, grid_.axes().normal);
    if (cosine < min_cosine) return;
    if (!times_.empty() && (batch_.size() >= rays_in_batch || !alike(*times_.front().time, time))) {
      trace();
    }
    times_.push_back({&time, cosine});
    auto const start = grid_.axes().normal * ray_lift;
    auto const rays = settings_.rays_per_cell;
    for (auto const& cell : grid_.cells()) {
      auto const first = rays * (number + turn_of(cell));
      for (std::size_t i = 0; i < rays; ++i) {
        batch_.push_back({grid_.point(cell, first + i) + start, sun});
      }
    }
  }

  std::vector<MapValue> finish() {
    trace();
    return std::move(values_);
  }

 private:
  struct Added {
    MapTime const* time;
    double cosine;
  };

  void trace() {
    if (times_.empty()) return;
    passed_.resize(batch_.size());
    auto const& first = *times_.front().time;
    rays_.transmittances(
        batch_, {.receiver = receiver_, .factors = first.factors, .deployments = first.deployments},
        passed_);
    auto passed = passed_.begin();
    double const share = settings_.hours_per_step / static_cast<double>(settings_.rays_per_cell);
    constexpr double watts_in_kilowatt = 1000.0;
    for (auto const& [time, cosine] : times_) {
      for (auto& value : values_) {
        double hours = 0.0;
        for (std::size_t i = 0; i < settings_.rays_per_cell; ++i) hours += share * *passed++;
        value.hours += hours;
        value.energy += hours * cosine * time->beam / watts_in_kilowatt;
      }
    }
    times_.clear();
    batch_.clear();
  }

  RayScene const& rays_;
  SurfaceId receiver_;
  MapGrid const& grid_;
  MapSettings settings_;
  std::vector<Added> times_;
  std::vector<Ray> batch_;
  std::vector<double> passed_;
  std::vector<MapValue> values_;
};

// The values of each cell of a receiver's grid, in order. A cell's value is the mean over rays
// towards the sun from a few of its points, which take turns from time to time. `done` is called
// with the number of times that are complete.
std::vector<MapValue> trace_map(RayScene const& rays, SurfaceId receiver, MapGrid const& grid,
                                std::vector<MapTime> const& times, MapSettings const& settings,
                                std::function<void(std::size_t)> const& done) {
  RayBatch batch(rays, receiver, grid, settings);
  for (std::size_t i = 0; i < times.size(); ++i) {
    batch.add(times[i], i);
    done(i + 1);
  }
  return batch.finish();
}

struct MappedReceiver {
  SurfaceId id;
  MapGrid grid;
};

// The surfaces that a pattern may choose: those that EnergyPlus shades, and all shading surfaces of
// the model.
std::vector<SurfaceId> may_be_mapped(SceneAssembly const& scene) {
  auto ids = scene.shown_receivers();
  for (auto const id : scene.shading_surfaces()) {
    if (area(scene.surfaces()[id].polygon) > 0.0) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

std::vector<MappedReceiver> make_grids(SceneAssembly const& scene, MapTask const& request) {
  auto const& pattern = request.receivers;
  auto const chosen = pattern.empty() ? scene.shown_receivers()
                                      : choose_receivers(scene, may_be_mapped(scene), "--receivers",
                                                         pattern, "exterior or shading surface");
  if (chosen.empty()) throw Error("the model has no exterior surface to map");
  std::vector<MappedReceiver> receivers;
  std::size_t cells = 0;
  for (auto const id : chosen) {
    auto const& surface = scene.surfaces()[id];
    try {
      receivers.push_back({id, MapGrid(surface.polygon, request.spacing)});
    } catch (Error const& error) {
      throw Error(fmt::format("--spacing {}: {}: {}", request.spacing, printable(surface.name),
                              error.what()));
    }
    cells += receivers.back().grid.cells().size();
    if (cells > MapGrid::max_cells) {
      throw Error(fmt::format(
          "--spacing {}: the receivers have more than {} cells: use a larger spacing, or choose "
          "fewer with --receivers",
          request.spacing, MapGrid::max_cells));
    }
  }
  return receivers;
}

std::vector<MapTime> times_of(MapTask const& request, ShadeOptics const& optics) {
  std::vector<MapTime> times;
  for (auto const& time : request.run.times) {
    times.push_back({time.sun, time.beam, schedule_values(request.run, time, optics.factor_names()),
                     schedule_values(request.run, time, optics.deployment_names())});
  }
  return times;
}

}  // namespace

std::string perform(MapTask const& request, SceneAssembly& scene, Messages const& messages) {
  describe_scene(scene, messages);
  auto const receivers = make_grids(scene, request);
  scene.optics().update({});
  RayScene const rays(scene.scene(), {.screens = ScreenDetail::automatic});
  auto const times = times_of(request, scene.optics());
  MapSettings const settings{1.0 / request.run.steps_per_hour,
                             static_cast<std::size_t>(request.rays_per_cell)};
  Progress progress("tracing rays to the sun", receivers.size() * times.size(), request.progress);
  std::vector<ReceiverMap> maps;
  std::size_t cells = 0;
  for (auto const& [id, grid] : receivers) {
    auto const before = maps.size() * times.size();
    auto const& surface = scene.surfaces()[id];
    maps.push_back({surface.name, surface.polygon,
                    trace_map(rays, id, grid, times, settings,
                              [&](std::size_t done) { progress.at(before + done); })});
    cells += grid.cells().size();
  }
  write_maps(request.file, maps);
  return fmt::format("{} receivers, {} cells, {} times with the sun up", maps.size(), cells,
                     times.size());
}

}  // namespace gpu_shading::energyplus
