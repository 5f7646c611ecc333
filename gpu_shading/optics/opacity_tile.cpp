#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/perforation.h"

namespace gpu_shading {
namespace {

constexpr double most_texels = 1U << 26U;

void check_positive(std::string_view field, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw Error(fmt::format("{} is {:.9g} m, expected more than 0", field, value));
}

void check_threshold(std::optional<double> threshold) {
  if (!threshold || (*threshold >= 0.0 && *threshold < 1.0)) return;
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

constexpr int points = 8;  // each way

// How many of points x points in each of columns x rows parts of the tile are solid.
std::vector<int> solid_points(HolePattern const& pattern, int columns, int rows) {
  std::vector<int> solid;
  solid.reserve(index(0, rows, columns));
  double const step_u = pattern.width() / columns / points;
  double const step_v = pattern.height() / rows / points;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      int count = 0;
      for (int v = row * points; v < (row + 1) * points; ++v) {
        for (int u = column * points; u < (column + 1) * points; ++u) {
          if (!pattern.is_open((u + 0.5) * step_u, (v + 0.5) * step_v)) ++count;
        }
      }
      solid.push_back(count);
    }
  }
  return solid;
}

}  // namespace

OpacityTile::OpacityTile(double width, double height, int columns, int rows,
                         std::vector<float> opacity, std::optional<double> threshold)
    : width_(width),
      height_(height),
      columns_(columns),
      rows_(rows),
      opacity_(std::move(opacity)),
      threshold_(threshold) {
  check_positive("tile width", width);
  check_positive("tile height", height);
  check_threshold(threshold);
  if (columns < 1 || rows < 1 ||
      opacity_.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    throw Error(
        fmt::format("texture has {} texels, expected {} x {}", opacity_.size(), columns, rows));
  }
  for (float const value : opacity_) {
    if (!(value >= 0.0F && value <= 1.0F)) {
      throw Error(fmt::format("opacity is {:.9g}, expected 0 to 1", value));
    }
  }
}

OpacityTile::OpacityTile(HolePattern const& pattern, double texel, std::optional<double> threshold)
    : width_(pattern.width()), height_(pattern.height()), threshold_(threshold) {
  check_positive("texel", texel);
  check_threshold(threshold);
  if (width_ / texel * (height_ / texel) > most_texels) {
    throw Error(fmt::format("texel is {:.9g} m, too small for a tile of {:.9g} x {:.9g} m", texel,
                            width_, height_));
  }
  columns_ = texels_along(width_, texel);
  rows_ = texels_along(height_, texel);
  std::vector<int> const quarters = solid_points(pattern, 2 * columns_, 2 * rows_);
  int const margin = threshold ? 1 : 0;
  int const quarters_seen = (2 + 2 * margin) * (2 + 2 * margin);
  opacity_.reserve(quarters.size() / 4);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      int solid = 0;
      for (int v = -margin; v < 2 + margin; ++v) {
        for (int u = -margin; u < 2 + margin; ++u) {
          solid += quarters[index(around(2 * column + u, 2 * columns_),
                                  around(2 * row + v, 2 * rows_), 2 * columns_)];
        }
      }
      opacity_.push_back(static_cast<float>(solid) /
                         static_cast<float>(quarters_seen * points * points));
    }
  }
}

double OpacityTile::open_fraction() const {
  double open = 0.0;
  for (float const value : opacity_) {
    if (threshold_) {
      open += static_cast<double>(value) > *threshold_ ? 0.0 : 1.0;
    } else {
      open += 1.0 - static_cast<double>(value);
    }
  }
  return open / static_cast<double>(opacity_.size());
}

double OpacityTile::web() const {
  double const limit = threshold_.value_or(0.5);
  auto const solid = [&](int column, int row) {
    return static_cast<double>(opacity_[index(column, row, columns_)]) > limit;
  };
  double narrowest = std::numeric_limits<double>::infinity();
  constexpr std::array<std::pair<int, int>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  for (auto const& [du, dv] : directions) {
    double const stride = std::hypot(du * texel_width(), dv * texel_height());
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (solid(column, row)) continue;
        // The run that begins next to this open texel, as long as it may be the shortest. It ends
        // here at the latest, having come around.
        int u = column;
        int v = row;
        for (int run = 0; run * stride < narrowest; ++run) {
          u = around(u + du, columns_);
          v = around(v + dv, rows_);
          if (solid(u, v)) continue;
          if (run > 0) narrowest = run * stride;
          break;
        }
      }
    }
  }
  constexpr double cos_eighth = 0.92387953251128674;  // cos(pi / 8)
  return std::max(cos_eighth * narrowest, 2.0 * std::max(texel_width(), texel_height()));
}

double OpacityTile::hole() const {
  double const limit = threshold_.value_or(0.5);
  auto const open = [&](int column, int row) {
    return static_cast<double>(opacity_[index(column, row, columns_)]) <= limit;
  };
  double length = 0.0;
  std::size_t edges = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (!open(column, row)) continue;
      length += texel_width() + texel_height();
      if (!open(around(column + 1, columns_), row)) ++edges;
      if (!open(column, around(row + 1, rows_))) ++edges;
    }
  }
  return edges == 0 ? std::numeric_limits<double>::infinity() : length / static_cast<double>(edges);
}

}  // namespace gpu_shading
