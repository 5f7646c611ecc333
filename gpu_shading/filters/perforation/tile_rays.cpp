#include "filters/perforation/tile_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gpu_shading {
namespace {

constexpr int block_log2 = 3;
constexpr float highest = OpacityTile::solid_texel;

std::size_t parts(std::size_t count, int size_log2) {
  return (count + (std::size_t{1} << static_cast<unsigned>(size_log2)) - 1) >>
         static_cast<unsigned>(size_log2);
}

// The largest value that a shader, after dividing it, does not find above the threshold.
float max_open(float threshold) {
  float value = threshold * highest;
  while (value / highest > threshold) value = std::nextafter(value, 0.0F);
  for (float next = value; next / highest <= threshold;) {
    value = next;
    next = std::nextafter(next, 2.0F * highest);
  }
  return value;
}

// Wraps into 0 .. count (exclusive), from at most one count away.
double wrapped(double place, double count) {
  if (place >= count) place -= count;
  if (place < 0.0) place += count;
  // Rounding may have produced a value just below 0.
  return place < count ? place : 0.0;
}

}  // namespace

// A point on a ray's path, in texels from the centre of the first texel.
class TileRays::Walk {
 public:
  Walk(TileRays const& rays, double x, double y, Direction const& direction)
      : rays_(rays), direction_(direction), x_(x), y_(y) {}

  double x() const { return x_; }
  double y() const { return y_; }
  double shift() const { return shift_; }

  void advance(double length) {
    shift_ += length;
    x_ = wrapped(x_ + direction_.along_x * length, rays_.columns_);
    y_ = wrapped(y_ + direction_.along_y * length, rays_.rows_);
  }

  std::uint16_t largest(std::size_t level) const {
    Level const& blocks = rays_.levels_[level];
    auto const size = static_cast<unsigned>(blocks.size_log2);
    return blocks.largest[(static_cast<std::size_t>(y_) >> size) * blocks.columns +
                          (static_cast<std::size_t>(x_) >> size)];
  }

  double length_in_block(std::size_t level) const {
    return length_in_square(static_cast<unsigned>(rays_.levels_[level].size_log2));
  }

  // The path through the area between four centres of texels, where the interpolated value is
  // first + slope * shift + curvature * shift^2.
  struct Cell {
    double length;
    double first;
    double slope;
    double curvature;

    // Where the value first exceeds a limit; above `length` if nowhere.
    double exceeds(double limit) const {
      if (first > limit) return 0.0;
      // The smaller of the roots that are not negative, without cancellation.
      double const c = first - limit;
      double const inside = slope * slope - 4.0 * curvature * c;
      if (inside < 0.0) return beyond;
      double const q = -0.5 * (slope + std::copysign(std::sqrt(inside), slope));
      double found = beyond;
      for (double const root :
           {q != 0.0 ? c / q : beyond, curvature != 0.0 ? q / curvature : beyond}) {
        if (root >= 0.0 && root < found && slope + 2.0 * curvature * root > 0.0) found = root;
      }
      return found;
    }
    double falls(double limit) const {
      return Cell{length, -first, -slope, -curvature}.exceeds(-limit);
    }
    double highest_at() const {
      double const top = curvature < 0.0 ? std::clamp(-0.5 * slope / curvature, 0.0, length) : 0.0;
      return at(top) >= at(length) ? top : length;
    }
    double at(double shift) const { return first + shift * (slope + shift * curvature); }

    static constexpr double beyond = std::numeric_limits<double>::infinity();
  };
  std::array<double, 4> corners() const {
    return rays_.corners(static_cast<int>(x_), static_cast<int>(y_));
  }
  double length_in_cell() const { return length_in_square(0); }
  Cell cell(std::array<double, 4> const& corners) const {
    auto const [a, b, c, d] = corners;
    double const x = x_ - std::floor(x_);
    double const y = y_ - std::floor(y_);
    double const dx = direction_.along_x;
    double const dy = direction_.along_y;
    double const twist = a - b - c + d;
    return {.length = length_in_cell(),
            .first = a + (b - a) * x + (c - a) * y + twist * x * y,
            .slope = (b - a) * dx + (c - a) * dy + twist * (x * dy + y * dx),
            .curvature = twist * dx * dy};
  }

 private:
  double length_in_square(unsigned size) const {
    return std::min(length_in_block(x_, direction_.per_x, rays_.columns_, size),
                    length_in_block(y_, direction_.per_y, rays_.rows_, size));
  }
  static double length_in_block(double place, double per_texel, int count, unsigned size_log2) {
    int const block = static_cast<int>(place) >> size_log2;
    int const end =
        per_texel > 0.0 ? std::min((block + 1) << size_log2, count) : block << size_log2;
    return (end - place) * per_texel;
  }

  TileRays const& rays_;
  Direction const& direction_;
  double x_;
  double y_;
  double shift_ = 0.0;
};

TileRays::TileRays(OpacityTile const& tile)
    : tile_(tile),
      texels_(tile.opacity().data()),
      columns_(tile.columns()),
      rows_(tile.rows()),
      thresholded_(tile.threshold().has_value()),
      max_open_(max_open(static_cast<float>(tile.threshold().value_or(0.0)))) {
  add_blocks();
  while (levels_.back().largest.size() > 1) add_level_above(levels_.back());
}

// Interpolated values in a block depend on its texels and on one more each way.
void TileRays::add_blocks() {
  auto const columns = static_cast<std::size_t>(columns_);
  auto const rows = static_cast<std::size_t>(rows_);
  Level level{.size_log2 = block_log2, .columns = parts(columns, block_log2), .largest = {}};
  level.largest.reserve(level.columns * parts(rows, block_log2));
  std::vector<std::uint16_t> of_rows(columns + 1);
  constexpr std::size_t size = std::size_t{1} << static_cast<unsigned>(block_log2);
  for (std::size_t row = 0; row < rows; row += size) {
    std::fill(of_rows.begin(), of_rows.end(), std::uint16_t{0});
    for (std::size_t y = row; y <= std::min(row + size, rows); ++y) {
      std::uint16_t const* const texels = texels_ + y % rows * columns;
      for (std::size_t x = 0; x < columns; ++x) of_rows[x] = std::max(of_rows[x], texels[x]);
    }
    of_rows[columns] = of_rows[0];
    for (std::size_t column = 0; column < columns; column += size) {
      level.largest.push_back(*std::max_element(
          of_rows.begin() + static_cast<std::ptrdiff_t>(column),
          of_rows.begin() + static_cast<std::ptrdiff_t>(std::min(column + size, columns) + 1)));
    }
  }
  levels_.push_back(std::move(level));
}

void TileRays::add_level_above(Level const& level) {
  std::size_t const rows = level.largest.size() / level.columns;
  Level above{.size_log2 = level.size_log2 + 1, .columns = parts(level.columns, 1), .largest = {}};
  above.largest.assign(above.columns * parts(rows, 1), 0);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < level.columns; ++column) {
      std::uint16_t& largest = above.largest[row / 2 * above.columns + column / 2];
      largest = std::max(largest, level.largest[row * level.columns + column]);
    }
  }
  levels_.push_back(std::move(above));
}

std::array<double, 4> TileRays::corners(int column, int row) const {
  int const next_column = column + 1 == columns_ ? 0 : column + 1;
  int const next_row = row + 1 == rows_ ? 0 : row + 1;
  auto const texel = [&](int at_column, int at_row) {
    return static_cast<double>(
        texels_[static_cast<std::size_t>(at_row) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(at_column)]);
  };
  return {texel(column, row), texel(next_column, row), texel(column, next_row),
          texel(next_column, next_row)};
}

float TileRays::sample(double x, double y) const {
  int const column = static_cast<int>(x);
  int const row = static_cast<int>(y);
  auto const part_x = static_cast<float>(x - column);
  auto const part_y = static_cast<float>(y - row);
  auto const [a, b, c, d] = corners(column, row);
  auto const mixed = [](double from, double to, float part) {
    return static_cast<float>(from) + part * static_cast<float>(to - from);
  };
  float const below = mixed(a, b, part_x);
  float const above = mixed(c, d, part_x);
  return below + part_y * (above - below);
}

float TileRays::opacity(double u, double v) const {
  float const value = sample(wrapped(u / tile_.texel_width() - 0.5, columns_),
                             wrapped(v / tile_.texel_height() - 0.5, rows_));
  if (!thresholded_) return value / highest;
  return value > max_open_ ? 1.0F : 0.0F;
}

TileRays::Direction TileRays::direction(double phi) const {
  double const along_x = std::cos(phi) / tile_.texel_width();
  double const along_y = std::sin(phi) / tile_.texel_height();
  return {.along_x = along_x, .along_y = along_y, .per_x = 1.0 / along_x, .per_y = 1.0 / along_y};
}

double TileRays::beyond_edge() const {
  return 1e-4 * std::min(tile_.texel_width(), tile_.texel_height());
}

std::size_t TileRays::follow(double u, double v, Direction const& direction, double farthest,
                             std::vector<Rise>& rises) const {
  rises.clear();
  Walk walk(*this, wrapped(u / tile_.texel_width() - 0.5, columns_),
            wrapped(v / tile_.texel_height() - 0.5, rows_), direction);
  double const beyond = beyond_edge();
  // The value to exceed.
  float passed = thresholded_ ? max_open_ : sample(walk.x(), walk.y());
  // Smaller rises of fractional opacity are ignored.
  float const negligible = thresholded_ ? 0.0F : (1.0F - solid) * highest;
  auto const nothing_in = [&](std::uint16_t largest) {
    return static_cast<float>(largest) <= passed + negligible;
  };
  std::size_t steps = 1;
  if (nothing_in(levels_.back().largest.front())) return steps;
  std::size_t level = 0;
  while (walk.shift() < farthest) {
    ++steps;
    if (nothing_in(walk.largest(level))) {
      if (level + 1 == levels_.size()) break;
      walk.advance(walk.length_in_block(level) + beyond);
      ++level;
      continue;
    }
    if (level > 0) {
      --level;
      continue;
    }
    auto const corners = walk.corners();
    if (nothing_in(static_cast<std::uint16_t>(*std::ranges::max_element(corners)))) {
      walk.advance(walk.length_in_cell() + beyond);
      continue;
    }
    auto const cell = walk.cell(corners);
    double const rise = cell.exceeds(static_cast<double>(passed));
    if (rise <= cell.length) {
      if (thresholded_) {
        rises.push_back({walk.shift() + rise, 1.0F});
        break;
      }
      double const top = cell.highest_at();
      auto const value = static_cast<float>(cell.at(top));
      rises.push_back({walk.shift() + 0.5 * (rise + top), value / highest});
      passed = std::max(passed, value);
      if (value >= solid * highest) break;
    }
    walk.advance(cell.length + beyond);
  }
  return steps;
}

bool TileRays::rise(Walk& walk, float limit, double farthest) const {
  std::size_t level = 0;
  while (walk.shift() < farthest) {
    if (static_cast<float>(walk.largest(level)) <= limit) {
      if (level + 1 == levels_.size()) return false;
      walk.advance(walk.length_in_block(level) + beyond_edge());
      ++level;
    } else if (level > 0) {
      --level;
    } else {
      auto const cell = walk.cell(walk.corners());
      double const rise = cell.exceeds(static_cast<double>(limit));
      walk.advance(std::min(rise, cell.length) + beyond_edge());
      if (rise <= cell.length) return true;
    }
  }
  return false;
}

bool TileRays::fall(Walk& walk, float limit, double farthest) const {
  while (walk.shift() < farthest) {
    auto const cell = walk.cell(walk.corners());
    double const fall = cell.falls(static_cast<double>(limit));
    walk.advance(std::min(fall, cell.length) + beyond_edge());
    if (fall <= cell.length) return true;
  }
  return false;
}

std::optional<TileRays::Run> TileRays::first_run(double u, double v, Direction const& direction,
                                                 double level, double farthest,
                                                 double longest) const {
  float const limit = thresholded_ ? max_open_ : static_cast<float>(level) * highest;
  Walk walk(*this, wrapped(u / tile_.texel_width() - 0.5, columns_),
            wrapped(v / tile_.texel_height() - 0.5, rows_), direction);
  if (sample(walk.x(), walk.y()) > limit || !rise(walk, limit, farthest)) return {};
  double const begin = walk.shift();
  if (!fall(walk, limit, begin + longest)) return Run{begin, longest, 0.0};
  double const end = walk.shift();
  rise(walk, limit, end + longest);
  return Run{begin, end - begin, walk.shift() - end};
}

}  // namespace gpu_shading
