#include "optics/solid_runs.h"

#include <algorithm>
#include <cmath>

#include "threads/parallel.h"

namespace gpu_shading {
namespace {

// Lengths are told apart by this part of a texel.
constexpr double resolution = 8.0;

// Twice around: runs that begin in the second turn count. A third one ends them.
constexpr std::size_t turns = 3;

// The solid part of the step from an open value to a solid one, or back.
double part_of_step(double open, double solid, double threshold) {
  return std::clamp((solid - threshold) / (solid - open), 0.0, 1.0);
}

// The same for a diagonal step, with the value halfway.
double part_of_diagonal(double open, double middle, double solid, double threshold) {
  return middle > threshold ? 0.5 + 0.5 * part_of_step(open, middle, threshold)
                            : 0.5 * part_of_step(middle, solid, threshold);
}

}  // namespace

// The last runs on a line through the raster, at first in a solid one that does not count.
// Positions are in steps along it.
class SolidRuns::Line {
 public:
  // Adds the solid run before, with the open one that ends here.
  void enter(double position, bool counts, double weight, Lengths& lengths) {
    double const open = position - open_from_;
    if (counts_) add(std::min(before_, open), weight, lengths);
    before_ = open;
    counts_ = counts;
    solid_from_ = position;
  }
  void leave(double position) {
    length_ = position - solid_from_;
    open_from_ = position;
  }
  // Whether a run that counts is not yet added.
  bool has_run() const { return counts_; }

 private:
  void add(double starts, double weight, Lengths& lengths) const {
    double const length = std::max(length_, 1.0 / resolution);
    auto const place = static_cast<std::size_t>(length * resolution);
    if (place >= lengths.size()) lengths.resize(place + 1);
    Runs& runs = lengths[place];
    runs.shortest = std::min(runs.shortest, length);
    runs.starts += weight * starts;
    runs.starts_by_length += weight * starts * length;
  }

  bool counts_ = false;
  double before_ = 0.0;  // length of the open run before the last solid one
  double solid_from_ = 0.0;
  double length_ = 0.0;  // of the last solid run
  double open_from_ = 0.0;
};

SolidRuns::SolidRuns(std::span<std::uint16_t const> texels, int columns, int rows,
                     std::span<Level const> levels)
    : texels_(texels),
      columns_(static_cast<std::size_t>(columns)),
      rows_(static_cast<std::size_t>(rows)),
      weight_(1.0 / static_cast<double>(levels.size())) {
  auto const add_in = [&](std::size_t direction) {
    for (Level const& level : levels) {
      if (direction == 0) add_along_rows(level, along_rows_);
      if (direction == 1) add_across_rows(level, 0, along_columns_);
      if (direction == 2) add_across_rows(level, 1, rising_);
      if (direction == 3) add_across_rows(level, -1, falling_);
    }
  };
  for_each_index(4, add_in);
}

double SolidRuns::step_along_diagonals(double stepped_over) const {
  return std::min(step(rising_, stepped_over), step(falling_, stepped_over));
}

// With a step s, rays step over a run of length l < s with the probability 1 - l / s.
double SolidRuns::step(Lengths const& lengths, double stepped_over) {
  double longest = std::numeric_limits<double>::infinity();
  double starts = 0.0;
  double starts_by_length = 0.0;
  bool found = false;
  for (Runs const& runs : lengths) {
    if (runs.starts == 0.0) continue;
    if (found && starts - starts_by_length / runs.shortest > stepped_over) break;
    longest = runs.shortest;
    found = true;
    starts += runs.starts;
    starts_by_length += runs.starts_by_length;
  }
  return longest;
}

void SolidRuns::add_along_rows(Level const& level, Lengths& lengths) const {
  double const weight = weight_ / static_cast<double>(texels_.size());
  for (std::size_t row = 0; row < rows_; ++row) {
    auto const texels = texels_.subspan(row * columns_, columns_);
    Line line;
    bool in_solid = true;
    for (std::size_t turn = 0; turn < turns && (turn < 2 || line.has_run()); ++turn) {
      for (std::size_t column = 0; column < columns_; ++column) {
        std::uint16_t const texel = texels[column];
        if ((texel >= level.solid) == in_solid) continue;
        in_solid = !in_solid;
        std::uint16_t const before = texels[(column == 0 ? columns_ : column) - 1];
        auto const position = static_cast<double>(turn * columns_ + column);
        if (in_solid) {
          line.enter(position - part_of_step(before, texel, level.threshold), turn == 1, weight,
                     lengths);
        } else {
          line.leave(position - 1.0 + part_of_step(texel, before, level.threshold));
        }
      }
    }
  }
}

void SolidRuns::add_across_rows(Level const& level, int du, Lengths& lengths) const {
  // As many rows as a diagonal has columns, so that each line crosses everything on its way.
  std::size_t const most = (du == 0 ? 1 : (columns_ + rows_ - 1) / rows_) * rows_;
  double const weight = weight_ / static_cast<double>(columns_ * most);
  std::vector<Line> lines(columns_);
  std::vector<std::uint8_t> in_solid(columns_, 1);
  auto const part = [&](std::uint16_t const* row, std::uint16_t const* row_before,
                        std::size_t column) {
    std::size_t const column_before = du == 0  ? column
                                      : du > 0 ? (column == 0 ? columns_ : column) - 1
                                               : (column + 1 == columns_ ? 0 : column + 1);
    double const here = row[column];
    double const before = row_before[column_before];
    double const open = std::min(here, before);
    double const solid = std::max(here, before);
    if (du == 0) return part_of_step(open, solid, level.threshold);
    double const middle = 0.25 * (here + before + row[column_before] + row_before[column]);
    return part_of_diagonal(open, middle, solid, level.threshold);
  };
  // Compares many lines at once, most of which go on in their runs.
  constexpr std::size_t block_size = 32;
  auto const differ = [&](std::uint16_t const* row, std::uint8_t const* before, std::size_t count) {
    std::uint8_t any = 0;
    for (std::size_t at = 0; at < count; ++at) {
      any |=
          static_cast<std::uint8_t>(static_cast<std::uint8_t>(row[at] >= level.solid) ^ before[at]);
    }
    return any != 0;
  };
  auto const has_run = [](Line const& line) { return line.has_run(); };
  for (std::size_t step = 0; step < turns * most; ++step) {
    if (step >= 2 * most && std::none_of(lines.begin(), lines.end(), has_run)) break;
    std::uint16_t const* const row = texels_.data() + step % rows_ * columns_;
    std::uint16_t const* const row_before = texels_.data() + (step + rows_ - 1) % rows_ * columns_;
    auto const position = static_cast<double>(step);
    auto const meet_line = [&](std::size_t line, std::size_t column) {
      bool const is_solid = row[column] >= level.solid;
      if (is_solid == (in_solid[line] != 0)) return;
      in_solid[line] = is_solid ? 1 : 0;
      double const solid_part = part(row, row_before, column);
      if (is_solid) {
        lines[line].enter(position - solid_part, step / most == 1, weight, lengths);
      } else {
        lines[line].leave(position - 1.0 + solid_part);
      }
    };
    // Lines `first` to `end` cross the row's texels from `column` on.
    auto const meet = [&](std::size_t first, std::size_t end, std::size_t column) {
      while (first < end) {
        std::size_t const block = std::min(block_size, end - first);
        if (differ(row + column, &in_solid[first], block)) {
          for (std::size_t at = 0; at < block; ++at) meet_line(first + at, column + at);
        }
        first += block;
        column += block;
      }
    };
    // The texel of the first line.
    std::size_t const turned = step % columns_;
    std::size_t const column = du == 0 || turned == 0 ? 0 : du > 0 ? turned : columns_ - turned;
    meet(0, columns_ - column, column);
    meet(columns_ - column, columns_, 0);
  }
}

}  // namespace gpu_shading
