#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <map>
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
#include "tasks/run_conditions.h"

namespace gpu_shading::energyplus {
namespace {

// A time at which the sun is up.
struct MapTime {
  SunDirection sun;
  double beam = 0.0;       // direct normal irradiance, W/m2
  std::size_t number = 0;  // of the run's times
  ShadeConditions const* conditions = nullptr;
  double weight = 1.0;  // between positions of moving shades
};

struct MapSettings {
  double hours_per_step = 1.0;
  std::size_t rays_per_cell = 4;  // at each time
};

bool alike(MapTime const& a, MapTime const& b) {
  return a.conditions->factors == b.conditions->factors &&
         a.conditions->deployments == b.conditions->deployments;
}

// Neighbouring cells begin at other points, so that the edge of a shadow along a row or a column
// does not pass all of them in one place.
std::size_t turn_of(MapCell const& cell) {
  constexpr std::size_t from_row_to_row = 37;
  return static_cast<std::size_t>(cell.column) +
         from_row_to_row * static_cast<std::size_t>(cell.row);
}

struct MappedReceiver {
  SurfaceId id;
  MapGrid grid;
  std::vector<MapValue> values;  // by cell
};

// Where a receiver's grid is, which moves with a moving shade.
struct GridPlace {
  PointMotion move;
  glm::dvec3 normal;
};

// Rays of successive times with the same conditions, traced together. A cell's value is the mean
// over rays towards the sun from a few of its points, which take turns from time to time.
class RayBatch {
 public:
  RayBatch(RayScene const& rays, MappedReceiver& receiver, GridPlace place,
           MapSettings const& settings)
      : rays_(rays), receiver_(receiver), place_(std::move(place)), settings_(settings) {}

  void add(MapTime const& time) {
    auto const sun = to_vector(time.sun);
    double const cosine = glm::dot(sun, place_.normal);
    if (cosine < min_cosine) return;
    if (!times_.empty() && (batch_.size() >= rays_in_batch || !alike(*times_.front().time, time))) {
      trace();
    }
    times_.push_back({&time, cosine});
    auto const start = place_.normal * ray_lift;
    auto const rays = settings_.rays_per_cell;
    for (auto const& cell : receiver_.grid.cells()) {
      auto const first = rays * (time.number + turn_of(cell));
      for (std::size_t i = 0; i < rays; ++i) {
        batch_.push_back({place_.move(receiver_.grid.point(cell, first + i)) + start, sun});
      }
    }
  }

  void trace() {
    if (times_.empty()) return;
    passed_.resize(batch_.size());
    auto const& first = *times_.front().time->conditions;
    rays_.transmittances(
        batch_,
        {.receiver = receiver_.id, .factors = first.factors, .deployments = first.deployments},
        passed_);
    auto passed = passed_.begin();
    double const share = settings_.hours_per_step / static_cast<double>(settings_.rays_per_cell);
    constexpr double watts_in_kilowatt = 1000.0;
    for (auto const& [time, cosine] : times_) {
      for (auto& value : receiver_.values) {
        double hours = 0.0;
        for (std::size_t i = 0; i < settings_.rays_per_cell; ++i) hours += share * *passed++;
        hours *= time->weight;
        value.hours += hours;
        value.energy += hours * cosine * time->beam / watts_in_kilowatt;
      }
    }
    times_.clear();
    batch_.clear();
  }

 private:
  struct Added {
    MapTime const* time;
    double cosine;
  };

  RayScene const& rays_;
  MappedReceiver& receiver_;
  GridPlace place_;
  MapSettings settings_;
  std::vector<Added> times_;
  std::vector<Ray> batch_;
  std::vector<double> passed_;
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
      MapGrid grid(surface.polygon, request.spacing);
      std::vector<MapValue> values(grid.cells().size());
      receivers.push_back({id, std::move(grid), std::move(values)});
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

// The times, by the positions of the moving shades.
std::map<std::vector<double>, std::vector<MapTime>> times_of(
    RunTimes const& run, std::vector<ShadeConditions> const& conditions) {
  std::map<std::vector<double>, std::vector<MapTime>> by_positions;
  for (std::size_t i = 0; i < run.times.size(); ++i) {
    auto const& time = run.times[i];
    for (auto const& [positions, weight] : conditions[i].positions) {
      by_positions[positions].push_back({time.sun, time.beam, i, &conditions[i], weight});
    }
  }
  return by_positions;
}

}  // namespace

std::string perform(MapTask const& request, SceneAssembly& scene, Messages const& messages) {
  describe_scene(scene, messages);
  auto receivers = make_grids(scene, request);
  auto const conditions = read_conditions(request.run, scene);
  auto const by_positions = times_of(request.run, conditions);
  MapSettings const settings{1.0 / request.run.steps_per_hour,
                             static_cast<std::size_t>(request.rays_per_cell)};
  std::size_t steps = 0;
  for (auto const& [positions, times] : by_positions) steps += receivers.size() * times.size();
  Progress progress("tracing rays to the sun", steps, request.progress);
  std::size_t done = 0;
  for (auto const& [positions, times] : by_positions) {
    RayScene const rays(scene.scene_at(positions), {.screens = ScreenDetail::automatic});
    for (auto& receiver : receivers) {
      auto const polygon = scene.placed(receiver.id, positions).polygon;
      bool const lies = area(polygon) > 0.0;
      RayBatch batch(rays, receiver, {scene.motion_of(receiver.id, positions), normal(polygon)},
                     settings);
      for (auto const& time : times) {
        if (lies) batch.add(time);
        progress.at(++done);
      }
      batch.trace();
    }
  }
  std::vector<ReceiverMap> maps;
  std::size_t cells = 0;
  for (auto& [id, grid, values] : receivers) {
    auto const& surface = scene.surfaces()[id];
    maps.push_back({surface.name, surface.polygon, std::move(values)});
    cells += grid.cells().size();
  }
  write_maps(request.file, maps);
  return fmt::format("{} receivers, {} cells, {} times with the sun up", maps.size(), cells,
                     request.run.times.size());
}

}  // namespace gpu_shading::energyplus
