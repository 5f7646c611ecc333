#include "backends/cpu/cpu_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "antialias/antialias.h"
#include "backends/cpu/replicates.h"
#include "gpu_shading/error.h"
#include "platform/instructions.h"
#include "platform/parallel.h"
#include "platform/stopwatch.h"
#include "view/tile_size.h"
#include "view/view.h"

namespace gpu_shading {
namespace {

// Number of casters of a view that take a thread long enough to be worth its waking.
constexpr std::size_t worth_a_thread = 2500;

// Pixels per side of a tile up to which holes smaller than pixels are replaced by their effective
// transmittance, which takes no account of where the receiver's edges cut them, unless by rows.
constexpr int largest_by_effect = 4096;

// The rows of a replicate that may suffice.
double rows_of(Tile const& tile, SampleUse use) {
  if (use == SampleUse::luminance) return tile.side / std::sqrt(double{replicates_at_once});
  return static_cast<double>(TileSize::rows_on(tile.side)) / replicates_at_once;
}

// The columns of a replicate; 0: as many as rows. A row's span costs nearly the same however fine
// its columns are. The lattice's shear makes the rounding of spans to them random.
int columns_of(double max_error, SampleUse use) {
  if (use == SampleUse::luminance) return 0;
  return static_cast<int>(128.0 / std::sqrt(max_error));
}

// Schedules and interior surfaces behind shades that transmit have no sums by row.
bool can_be_measured(CastersInView const& casters, ReceiverView const& view) {
  if (view.turned.empty() || view.at_pixels || view.grid || !casters.bodies.empty()) return false;
  if (casters.opaque()) return true;
  return !view.through && std::ranges::none_of(casters.shades, [](Shade const& shade) {
    return shade.schedule != Shade::unscheduled;
  });
}

}  // namespace

DeviceInfo cpu_device() {
  DeviceInfo info;
  info.renderer = "CPU";
  info.version = name(instructions());
  info.threads = available_threads();
  info.software = true;
  info.max_resolution = 16384;
  return info;
}

CpuBackend::CpuBackend(BackendInput const& input)
    : device_(cpu_device()),
      scene_(input.scene),
      coverage_(input.meshes),
      transmission_(input.transmission),
      statistics_(input.statistics) {}

CpuBackend::ViewScreens CpuBackend::note_screens(ReceiverView const& view,
                                                 std::vector<ScreensAtDirection>& directions) {
  ViewScreens noted;
  if (view.transmits) noted.numbers = transmission_.screens_among(view.casters);
  if (noted.numbers.empty()) return noted;
  if (directions.empty() || directions.back().towards_sun != view.towards_sun) {
    directions.push_back({view.towards_sun, {}, {}});
  }
  for (int const number : noted.numbers) {
    directions.back().add(
        number,
        may_see_effect(transmission_.screens()[number], view.towards_sun, view.pixel_area()),
        static_cast<double>(view.tile->counted_pixels) / static_cast<double>(noted.numbers.size()));
  }
  noted.direction = directions.size() - 1;
  return noted;
}

void CpuBackend::add(std::vector<ReceiverView> views) {
  Stopwatch const watch(statistics_.count_seconds);
  std::vector<ScreensAtDirection> directions;
  std::vector<ViewScreens> noted;
  noted.reserve(views.size());
  for (ReceiverView const& view : views) {
    noted.push_back(note_screens(view, directions));
    if (view.crowd == nullptr) continue;
    if (!crowd_) crowd_.emplace(scene_, *view.crowd, coverage_.pieces());
  }
  std::vector<std::vector<SheetInBeam>> sheets(directions.size());
  for_each_index(sheets.size(),
                 [&](std::size_t i) { sheets[i] = transmission_.sheets(directions[i]); });
  std::size_t const threads = static_cast<std::size_t>(available_threads());
  // Of each view, where there are fewer of them than threads.
  std::size_t const max_shares =
      views.empty() || views.size() >= threads ? 1 : (2 * threads - 1) / views.size() + 1;
  std::size_t const first = sums_.size();
  sums_.resize(first + views.size());
  for_each_index(views.size(), [&](std::size_t i) {
    ReceiverView const& view = views[i];
    ScreensInView screens;
    if (!noted[i].numbers.empty()) {
      screens = {&transmission_.screens(), sheets[noted[i].direction], noted[i].numbers};
    }
    std::size_t const casters =
        view.crowd != nullptr ? static_cast<std::size_t>(view.crowd_count) : view.casters.size();
    std::size_t const shares = screens.numbers.empty() ? casters / worth_a_thread : threads;
    sums_[first + i] =
        sums_of(view, screens, static_cast<int>(std::min({shares, max_shares, threads})));
  });
}

std::vector<ViewSums> CpuBackend::finish() { return std::exchange(sums_, {}); }

ViewSums CpuBackend::sums_of(ReceiverView const& view, ScreensInView const& screens, int threads) {
  Tile const& tile = *view.tile;
  std::vector<SurfaceId> flat;
  std::vector<Shade> shades;
  std::vector<CrownInBeam> crowns;
  View const in_front = view_in_front(*view.frame, tile.map, view.towards_sun);
  CastersInView casters{view.casters, {}, {screens}};
  ScreensInView& sheets = casters.bodies.screens;
  sheets.overlap = !view.at_pixels && screens.numbers.size() > 1 &&
                   any_overlap(*screens.screens, screens.numbers, in_front);
  sheets.every_hole = sheets.overlap || (!view.at_pixels && tile.side > largest_by_effect);
  sheets.by_rows = !view.at_pixels && !sheets.every_hole && edges_cut_rows(tile, in_front, sheets);
  if (view.transmits) {
    flat = transmission_.flat_among(view.casters);
    shades.reserve(flat.size());
    for (SurfaceId const id : flat) shades.push_back(transmission_.shade(id, view.towards_sun));
    casters.surfaces = flat;
    casters.shades = shades;
    crowns = transmission_.crowns_among(view.casters, view.towards_sun);
    casters.bodies.crowns = crowns;
  }
  if (view.crowd != nullptr) {
    casters.crowd = &*crowd_;
    casters.question = {view.receiver, view.towards_sun};
    if (view.is_window) casters.known = &lit_crowds_;
  }
  casters.grid = view.grid;
  bool const measurable = can_be_measured(casters, view);
  if (!view.at_pixels && !view.grid && !measurable)
    casters.repeats = repeats_among(scene_, casters.surfaces);
  Samples const samples = view.at_pixels ? Samples::pixels : Samples::fine;
  ViewSums sums;
  sums.receiver_pixels = tile.counted_pixels;
  try {
    if (measurable) {
      if (auto found = measured(view, casters, threads)) return *std::move(found);
    }
    if (view.through) {
      View const behind = view_behind(*view.frame, tile.map, view.towards_sun, 1.0);
      sums.parts = coverage_.sums_inside(tile, in_front, casters, samples, behind, view.interiors);
    } else {
      sums.parts.push_back(coverage_.sums(tile, in_front, casters, samples, threads));
    }
  } catch (Error const& error) {
    throw Error(fmt::format("surface '{}': {}", scene_[view.receiver].name, error.what()));
  }
  return sums;
}

std::optional<ViewSums> CpuBackend::measured(ReceiverView const& view, CastersInView const& casters,
                                             int threads) const {
  SampleUse const use = sample_use(casters);
  Replicates replicates(view.max_error, rows_of(*view.tile, use), columns_of(view.max_error, use));
  do {
    Tile const& tile = view.turned[replicates.turn()];
    TileGrid const grid = replicates.grid();
    View const in_front = view_in_front(*view.frame, tile.map, view.towards_sun);
    RowSums const sums =
        view.through
            ? coverage_.rows_inside(grid, tile, in_front, casters,
                                    view_behind(*view.frame, tile.map, view.towards_sun, 1.0),
                                    view.interiors)
            : coverage_.rows(grid, tile, in_front, casters, use, threads);
    if (!replicates.add(sums)) return std::nullopt;
  } while (!replicates.done());
  ViewSums sums{1, {}, replicates.uncertainty()};
  for (double const fraction : replicates.means()) sums.parts.push_back({fraction, {}});
  return sums;
}

}  // namespace gpu_shading
