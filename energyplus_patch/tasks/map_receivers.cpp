#include "tasks/map_receivers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/progress.h"
#include "platform/text.h"
#include "tasks/trace_maps.h"

namespace gpu_shading::energyplus {
namespace {

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

std::vector<SurfaceId> choose_receivers(SceneAssembly const& scene, std::string const& pattern) {
  if (pattern.empty()) return scene.shown_receivers();
  std::vector<SurfaceId> chosen;
  std::vector<std::string> names;
  for (auto const id : may_be_mapped(scene)) {
    auto const& name = scene.surfaces()[id].name;
    names.push_back(name);
    if (matches(pattern, name)) chosen.push_back(id);
  }
  if (chosen.empty()) {
    throw Error(fmt::format("--receivers {}: no exterior or shading surface matches{}",
                            in_quotes(pattern), did_you_mean(pattern, names)));
  }
  return chosen;
}

std::vector<MappedReceiver> make_grids(SceneAssembly const& scene, MapRequest const& request) {
  auto const chosen = choose_receivers(scene, request.receivers);
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
    if (cells > MapGrid::most_cells) {
      throw Error(fmt::format(
          "--spacing {}: the receivers have more than {} cells: use a larger spacing, or choose "
          "fewer with --receivers",
          request.spacing, MapGrid::most_cells));
    }
  }
  return receivers;
}

std::vector<double> values_of(std::vector<std::string> const& names, RunTimes const& run,
                              RunTime const& time) {
  std::vector<double> values(names.size());
  std::transform(names.begin(), names.end(), values.begin(),
                 [&](std::string const& name) { return schedule_value(run, time, name); });
  return values;
}

std::vector<MapTime> times_of(MapRequest const& request, ShadeOptics const& optics) {
  std::vector<MapTime> times;
  for (auto const& time : request.run.times) {
    times.push_back({time.sun, time.beam, values_of(optics.factor_names(), request.run, time),
                     values_of(optics.deployment_names(), request.run, time)});
  }
  return times;
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string map_receivers(MapRequest const& request, SceneAssembly& scene) {
  auto const receivers = make_grids(scene, request);
  scene.optics().update({});
  RayScene const rays(scene.scene(), {.screens = ScreenDetail::automatic});
  auto const times = times_of(request, scene.optics());
  MapSettings const settings{1.0 / request.run.steps_per_hour,
                             static_cast<std::size_t>(request.rays_per_cell)};
  std::unique_ptr<std::FILE, CloseFile> const descriptor(
      request.progress < 0 ? nullptr : fdopen(dup(request.progress), "w"));
  auto* const out = descriptor ? descriptor.get() : stderr;
  Progress progress("tracing rays to the sun", receivers.size() * times.size(), out,
                    isatty(fileno(out)) != 0, std::chrono::seconds(1));
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
