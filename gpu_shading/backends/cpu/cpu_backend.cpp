#include "backends/cpu/cpu_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

// Replicates that may suffice, as of a tile of so many pixels per side.
Replicates replicates_for(double max_error, int side, bool counted) {
  if (!counted) return {max_error, side / std::sqrt(double{replicates_at_once}), 0};
  int const rows = TileSize::rows_on(side) / static_cast<int>(replicates_at_once);
  // A row's span costs nearly the same however fine its columns are. The lattice's shear makes the
  // rounding of spans to them random.
  constexpr int columns_a_row = 42;
  return {max_error, static_cast<double>(rows), columns_a_row * rows};
}

// But for the outline.
SampledView on_grid(ReceiverView const& view, TileMap const& map, TileGrid const& grid) {
  SampledView sampled;
  sampled.grid = grid;
  sampled.in_front = in_pixels(view_in_front(*view.frame, map, view.towards_sun), grid);
  sampled.through = view.through;
  sampled.interiors = view.interiors;
  if (view.through) {
    sampled.behind = in_pixels(view_behind(*view.frame, map, view.towards_sun, 1.0), grid);
  }
  return sampled;
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
    double const pixel = view.pixel_area();
    directions.back().add(number,
                          may_see_effect(transmission_.screens()[number], view.towards_sun, pixel),
                          area(scene_[view.receiver].polygon) * view.cosine /
                              (pixel * static_cast<double>(noted.numbers.size())));
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
  std::vector<SurfaceId> flat;
  std::vector<Shade> shades;
  std::vector<CrownInBeam> crowns;
  CastersInView casters{view.casters, {}, {screens}};
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
  try {
    return view.at_pixels ? sampled(view, casters, threads) : measured(view, casters, threads);
  } catch (Error const& error) {
    throw Error(fmt::format("surface '{}': {}", scene_[view.receiver].name, error.what()));
  }
}

ViewSums CpuBackend::sampled(ReceiverView const& view, CastersInView const& casters,
                             int threads) const {
  Tile const& tile = *view.tile;
  TileGrid grid = pixels_of(tile);
  if (view.crowd != nullptr) {
    grid = sample_grid(tile, view_in_front(*view.frame, tile.map, view.towards_sun),
                       repeats_among(scene_, view.casters));
  }
  SampledView on_tile = on_grid(view, tile.map, grid);
  on_tile.slope = tile.lay.slope;
  on_tile.outline = outline_on(tile, grid);
  RowSums const rows = coverage_.rows(on_tile, casters, can_be_counted(casters), threads);
  // From samples to pixels of the tile: exactly all pixels where all samples are sunlit.
  double const own = total(rows.own);
  auto const pixels = static_cast<double>(tile.counted_pixels);
  ViewSums sums{own > 0.0 ? tile.counted_pixels : 0, std::vector<LuminanceSums>(rows.parts())};
  for (std::size_t part = 0; part < sums.parts.size(); ++part) {
    sums.parts[part].unscheduled = total(rows.lit[part]) * pixels / own;
    if (rows.scheduled.empty()) continue;
    sums.parts[part].scheduled = rows.scheduled[part];
    for (auto& [powers, sum] : sums.parts[part].scheduled) sum *= pixels / own;
  }
  return sums;
}

ViewSums CpuBackend::measured(ReceiverView const& view, CastersInView const& given,
                              int threads) const {
  CastersInView casters = given;
  bool const counted = can_be_counted(casters);
  std::array<TileMap, replicates_at_once> maps;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    maps.at(i) = fit_tile(*view.frame, scene_[view.receiver].polygon.outline, 1,
                          {.slope = view.slopes.at(i), .for_grids = true});
  }
  ScreensInView& sheets = casters.bodies.screens;
  sheets.overlap = sheets.numbers.size() > 1 &&
                   any_overlap(*sheets.screens, sheets.numbers,
                               view_in_front(*view.frame, maps.front(), view.towards_sun));
  sheets.every_hole = sheets.overlap || view.side > largest_by_effect;
  sheets.by_rows = true;
  sheets.lattices = replicates_at_once;
  Replicates replicates = replicates_for(view.max_error, view.side, counted);
  bool as_rectangle = false;
  do {
    TileMap const& map = maps.at(replicates.turn());
    SampledView lattice = on_grid(view, map, replicates.grid());
    lattice.slope = view.slopes.at(replicates.turn());
    lattice.outline = outline(view, map, lattice.grid, as_rectangle);
    if (replicates.add(coverage_.rows(lattice, casters, counted, threads))) continue;
    // The receiver is thinner than the nearest rows.
    as_rectangle = true;
    replicates = replicates_for(view.max_error, view.side, counted);
  } while (!replicates.done());
  return {1, replicates.means(), replicates.uncertainty()};
}

std::vector<ConvexArea> CpuBackend::outline(ReceiverView const& view, TileMap const& map,
                                            TileGrid const& grid, bool as_rectangle) const {
  View const pixels = in_pixels(view_of_plane(*view.frame, map), grid);
  std::vector<ConvexArea> areas;
  auto const add = [&](ProjectedPiece const& piece) { areas.push_back(piece.area(grid.side())); };
  if (as_rectangle) {
    add(ProjectedPiece(bounding_rectangle(*view.frame).outline, pixels));
  } else {
    coverage_.pieces().each(view.receiver, pixels, add);
  }
  return areas;
}

}  // namespace gpu_shading
