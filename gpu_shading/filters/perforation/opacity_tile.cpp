#include "gpu_shading/opacity_tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "filters/perforation/check_length.h"
#include "filters/perforation/tile_rays.h"
#include "gpu_shading/error.h"
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

// As described at OpacityTile::web().
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

// Maximum number of texels of a tile made from a pattern, each of which takes 256 points.
constexpr double max_texels = 1U << 26U;
constexpr float solid_value = OpacityTile::solid_texel;

void check_threshold(std::optional<double> threshold) {
  // In single precision, like the texels that are compared with it.
  if (!threshold || (*threshold >= 0.0 && static_cast<float>(*threshold) < 1.0F)) return;
  throw Error(fmt::format("opacity threshold is {:.9g}, expected 0 to below 1", *threshold));
}

int texels_along(double length, double texel) {
  return static_cast<int>(std::max(1.0, std::round(length / texel)));
}

std::size_t index(int column, int row, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column);
}

int around(int place, int count) { return (place + count) % count; }

void check_texels(std::size_t texels, int columns, int rows) {
  constexpr int most = OpacityTile::max_texels_a_side;
  if (columns > most || rows > most) {
    throw Error(fmt::format("texture is {} x {} texels, expected at most {} per side", columns,
                            rows, most));
  }
  if (columns < 1 || rows < 1 || texels != index(0, rows, columns)) {
    throw Error(fmt::format("texture has {} texels, expected {} x {}", texels, columns, rows));
  }
}

// Rounds halves down.
std::uint16_t quantised(double opacity) {
  return static_cast<std::uint16_t>(std::ceil(opacity * static_cast<double>(solid_value) - 0.5));
}

std::vector<std::uint16_t> quantised(std::vector<float> const& opacity) {
  std::vector<std::uint16_t> values;
  values.reserve(opacity.size());
  for (float const value : opacity) {
    if (!(value >= 0.0F && value <= 1.0F)) {
      throw Error(fmt::format("opacity is {:.9g}, expected 0 to 1", value));
    }
    values.push_back(quantised(static_cast<double>(value)));
  }
  return values;
}

// The smallest value above a threshold in 0 .. 1 (exclusive) as a shader compares it.
std::uint16_t min_solid(double threshold) {
  auto const limit = static_cast<float>(threshold);
  int value = std::max(0, static_cast<int>(limit * solid_value) - 1);
  while (static_cast<float>(value) / solid_value <= limit) ++value;
  return static_cast<std::uint16_t>(value);
}

constexpr int points_across = 8;  // each way

// How many of points_across x points_across in each of columns x rows parts of the tile are solid.
std::vector<std::uint8_t> solid_points(HolePattern const& pattern, int columns, int rows) {
  std::vector<std::uint8_t> solid;
  solid.reserve(index(0, rows, columns));
  double const step_u = pattern.width() / columns / points_across;
  double const step_v = pattern.height() / rows / points_across;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      int count = 0;
      for (int v = row * points_across; v < (row + 1) * points_across; ++v) {
        for (int u = column * points_across; u < (column + 1) * points_across; ++u) {
          if (!pattern.is_open((u + 0.5) * step_u, (v + 0.5) * step_v)) ++count;
        }
      }
      solid.push_back(static_cast<std::uint8_t>(count));
    }
  }
  return solid;
}

}  // namespace

OpacityTile::OpacityTile(double width, double height, int columns, int rows,
                         std::vector<std::uint16_t> opacity, std::optional<double> threshold)
    : width_(width), height_(height), columns_(columns), rows_(rows), threshold_(threshold) {
  check_length("tile width", width);
  check_length("tile height", height);
  check_threshold(threshold);
  check_texels(opacity.size(), columns, rows);
  opacity_ = std::make_shared<std::vector<std::uint16_t> const>(std::move(opacity));
  find_web();
}

OpacityTile::OpacityTile(double width, double height, int columns, int rows,
                         std::vector<float> const& opacity, std::optional<double> threshold)
    : OpacityTile(width, height, columns, rows, quantised(opacity), threshold) {}

OpacityTile::OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold)
    : width_(pattern.width()), height_(pattern.height()), threshold_(threshold) {
  check_positive("texel", texel);
  check_threshold(threshold);
  if (width_ / texel * (height_ / texel) > max_texels ||
      std::max(width_, height_) / texel > max_texels_a_side) {
    throw Error(fmt::format("texel is {:.9g} m, too small for a tile of {:.9g} x {:.9g} m", texel,
                            width_, height_));
  }
  columns_ = texels_along(width_, texel);
  rows_ = texels_along(height_, texel);
  std::vector<std::uint8_t> const quarters = solid_points(pattern, 2 * columns_, 2 * rows_);
  int const margin = threshold ? 1 : 0;
  int const quarters_seen = (2 + 2 * margin) * (2 + 2 * margin);
  std::vector<std::uint16_t> opacity;
  opacity.reserve(quarters.size() / 4);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      int solid = 0;
      for (int v = -margin; v < 2 + margin; ++v) {
        for (int u = -margin; u < 2 + margin; ++u) {
          solid += quarters[index(around(2 * column + u, 2 * columns_),
                                  around(2 * row + v, 2 * rows_), 2 * columns_)];
        }
      }
      opacity.push_back(
          quantised(static_cast<double>(solid) / (quarters_seen * points_across * points_across)));
    }
  }
  opacity_ = std::make_shared<std::vector<std::uint16_t> const>(std::move(opacity));
  find_web();
}

OpacityTile OpacityTile::stretched(double width, double height) const {
  check_positive("tile width", width);
  check_positive("tile height", height);
  OpacityTile tile = *this;
  tile.width_ = width;
  tile.height_ = height;
  tile.find_web();
  return tile;
}

double OpacityTile::open_fraction() const {
  std::uint64_t open = 0;
  if (threshold_) {
    std::uint16_t const solid = min_solid(*threshold_);
    for (std::uint16_t const value : *opacity_) open += value < solid ? 1U : 0U;
    return static_cast<double>(open) / static_cast<double>(opacity_->size());
  }
  for (std::uint16_t const value : *opacity_)
    open += static_cast<std::uint64_t>(solid_texel - value);
  return static_cast<double>(open) / solid_texel / static_cast<double>(opacity_->size());
}

void OpacityTile::find_web() { web_ = longest_step(*this); }

double OpacityTile::hole() const {
  std::uint16_t const solid = min_solid(threshold_.value_or(0.5));
  auto const columns = static_cast<std::size_t>(columns_);
  std::size_t open = 0;
  std::size_t edges = 0;
  for (int row = 0; row < rows_; ++row) {
    std::uint16_t const* const here = opacity_->data() + index(0, row, columns_);
    std::uint16_t const* const next = opacity_->data() + index(0, around(row + 1, rows_), columns_);
    unsigned open_here = 0;
    unsigned edges_here = 0;
    for (std::size_t column = 0; column < columns; ++column) {
      unsigned const is_open = here[column] < solid ? 1 : 0;
      open_here += is_open;
      edges_here += is_open & (next[column] < solid ? 0U : 1U);
    }
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      edges_here += (here[column] < solid ? 1U : 0U) & (here[column + 1] < solid ? 0U : 1U);
    }
    edges_here += (here[columns - 1] < solid ? 1U : 0U) & (here[0] < solid ? 0U : 1U);
    open += open_here;
    edges += edges_here;
  }
  if (edges == 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(open) * (texel_width() + texel_height()) / static_cast<double>(edges);
}

}  // namespace gpu_shading
