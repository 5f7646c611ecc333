#include "filters/perforation/longest_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "filters/perforation/places.h"
#include "filters/perforation/tile_rays.h"
#include "platform/parallel.h"

namespace gpu_shading {
namespace {

using Run = TileRays::Run;

constexpr std::size_t directions = 8;  // over pi
constexpr std::size_t places = 4096;
constexpr double stepped_over = 2e-3;  // of all rays, in any direction

// Whether a ray steps over a run, into the open one after it.
bool misses(Run const& run, double step) {
  double const beyond = std::ceil(run.before / step) * step - run.before - run.length;
  return beyond > 0.0 && beyond < run.after;
}

std::vector<Run> runs_along(TileRays const& rays, OpacityTile const& tile, double phi) {
  double const farthest = tile.width() + tile.height();
  double const longest = 256.0 * std::max(tile.texel_width(), tile.texel_height());
  TileRays::Direction const direction = rays.direction(phi);
  Places const place({.u = 0.0, .v = 0.0, .width = tile.width(), .height = tile.height()}, 0);
  std::vector<Run> runs;
  for (std::size_t n = 0; n < places; ++n) {
    // Fractional opacity, of which the largest value on a path counts, is the mean over levels.
    double const multiple = static_cast<double>(n) * std::numbers::phi;
    double const level = multiple - std::floor(multiple);
    if (auto const run =
            rays.first_run(place.u(n), place.v(n), direction, level, farthest, longest)) {
      runs.push_back(*run);
    }
  }
  return runs;
}

// Layers are at most this step apart, and more than half of it where there are three or more.
bool is_allowed(std::vector<Run> const& runs, double step) {
  constexpr double most = stepped_over * static_cast<double>(places);
  return std::ranges::all_of(std::array{1.0, 0.75, 0.5}, [&](double part) {
    auto const missed =
        std::ranges::count_if(runs, [&](Run const& run) { return misses(run, part * step); });
    return static_cast<double>(missed) <= most;
  });
}

// The length of a run: where all have one length, none is stepped over.
double longest_of(std::vector<Run> runs) {
  if (runs.empty()) return std::numeric_limits<double>::infinity();
  std::ranges::sort(runs, std::ranges::greater(), &Run::length);
  constexpr double next = 0.98;
  double step = std::numeric_limits<double>::infinity();
  for (Run const& run : runs) {
    if (run.length > next * step) continue;
    step = run.length;
    if (is_allowed(runs, step)) return step;
  }
  return runs.back().length;
}

}  // namespace

double longest_step(OpacityTile const& tile) {
  TileRays const rays(tile);
  std::array<double, directions> longest{};
  constexpr double between = std::numbers::pi / directions;
  for_each_index(directions, [&](std::size_t index) {
    longest[index] = longest_of(runs_along(rays, tile, static_cast<double>(index) * between));
  });
  // Between two directions, at most half that angle from the nearer one.
  return std::ranges::min(longest) * std::cos(0.5 * between);
}

}  // namespace gpu_shading
