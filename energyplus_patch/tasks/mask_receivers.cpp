#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "answers/cached_renderer.h"
#include "gpu_shading/error.h"
#include "gpu_shading/rays.h"
#include "platform/naming.h"
#include "platform/progress.h"
#include "reports/map_grid.h"
#include "reports/sky_mask.h"
#include "tasks/perform_task.h"

namespace gpu_shading::energyplus {
namespace {

// A receiver, or a point of its grid.
struct MaskedPlace {
  SurfaceId receiver;
  std::optional<glm::dvec3> point;
  MaskPoints to_sky;
  MaskPoints to_suns;  // more: there are fewer directions, and users read single ones
};

std::vector<SurfaceId> windows_among(std::vector<SurfaceId> const& all,
                                     SceneAssembly const& scene) {
  auto const& base_of = scene.model().shading.base_of;
  std::vector<SurfaceId> windows;
  std::copy_if(all.begin(), all.end(), std::back_inserter(windows),
               [&](SurfaceId id) { return base_of.contains(scene.surfaces()[id].name); });
  return windows.empty() ? all : windows;
}

std::vector<SurfaceId> masked_receivers(SceneAssembly const& scene, std::string const& pattern) {
  auto const all = scene.shown_receivers();
  if (all.empty()) throw Error("the model has no exterior surface to draw a mask of");
  if (pattern.empty()) return windows_among(all, scene);
  return choose_receivers(scene, all, "--receiver", pattern, "exterior surface");
}

std::vector<MaskedPlace> places_of(SceneAssembly const& scene, MaskTask const& task) {
  std::vector<MaskedPlace> places;
  constexpr std::size_t max_directions = 4'000'000;
  auto const directions = SkyGrid(task.step).size() + task.suns.size();
  auto const add = [&](MaskedPlace place) {
    places.push_back(std::move(place));
    if (places.size() * directions <= max_directions) return;
    throw Error(fmt::format(
        "--step {}: more than {} masks of {} directions: use a larger step or spacing, or choose "
        "fewer with --receiver",
        task.step, max_directions / directions, directions));
  };
  for (auto const id : masked_receivers(scene, task.receivers)) {
    auto const& polygon = scene.surfaces()[id].polygon;
    if (task.spacing <= 0.0) {
      constexpr int more = 4;
      add({id, std::nullopt, points_of(polygon, task.rays), points_of(polygon, more * task.rays)});
      continue;
    }
    auto const grid = naming(fmt::format("--points {}", task.spacing),
                             [&] { return MapGrid(polygon, task.spacing); });
    for (auto const& cell : grid.cells()) {
      auto const point = grid.axes().place(cell.centre);
      auto const from = point_at(point, grid.axes().normal);
      add({id, point, from, from});
    }
  }
  return places;
}

// By receiver, then by sun.
std::vector<std::vector<double>> render_suns(MaskTask const& task, SceneAssembly& scene,
                                             std::vector<SurfaceId> const& receivers,
                                             Messages const& messages) {
  auto answers = open_for_task(scene, receivers, messages);
  auto const areas = scene.areas();
  auto const& factors = scene.optics().factors();
  auto const rendered = answers.at(task.suns, receivers);
  std::vector<std::vector<double>> fractions(receivers.size());
  for (std::size_t i = 0; i < task.suns.size(); ++i) {
    auto const sun = to_vector(task.suns[i]);
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      fractions[k].push_back(sunlit_fraction(rendered[i][k].at(factors), areas[receivers[k]], sun));
    }
  }
  write_cache(answers, messages);
  return fractions;
}

}  // namespace

std::string perform(MaskTask const& task, SceneAssembly& scene, Messages const& messages) {
  auto const places = places_of(scene, task);
  std::vector<std::vector<double>> fractions;
  if (task.spacing <= 0.0) {
    std::vector<SurfaceId> receivers;
    receivers.reserve(places.size());
    for (auto const& place : places) receivers.push_back(place.receiver);
    fractions = render_suns(task, scene, receivers, messages);
  } else {
    scene.optics().update({});
  }
  auto const casters = scene.scene();
  RayScene const rays(casters, {.screens = ScreenDetail::automatic});
  auto const kinds = kinds_of(scene, casters);
  SkyGrid const grid(task.step);
  auto const directions = grid.directions();
  auto const areas = scene.areas();
  Progress progress("tracing rays to the sky", places.size(), task.progress);
  std::vector<ReceiverMask> masks;
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto const& [id, point, to_sky, to_suns] = places[i];
    RayConditions const conditions{.receiver = id,
                                   .factors = scene.optics().factors(),
                                   .deployments = scene.optics().deployments()};
    ReceiverMask mask{{scene.surfaces()[id].name, areas[id]},
                      point,
                      trace_shares(rays, conditions, kinds, to_sky, directions),
                      trace_shares(rays, conditions, kinds, to_suns, task.suns)};
    mask.horizon = trace_horizon(rays, conditions, kinds, to_sky, grid, mask.sky);
    for (std::size_t k = 0; k < mask.suns.size() && !point; ++k) {
      set_sunlit(mask.suns[k], fractions[i][k]);
    }
    masks.push_back(std::move(mask));
    progress.at(i + 1);
  }
  write_masks(task.file, masks);
  return fmt::format("{} mask{} of {} directions", masks.size(), masks.size() == 1 ? "" : "s",
                     directions.size());
}

}  // namespace gpu_shading::energyplus
