#include "optics/solid_runs.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gpu_shading {
namespace {

// Lengths of the runs that cross a row of texels, each texel on a line of its own.
class RunLengths {
 public:
  explicit RunLengths(std::size_t count) : lengths_(count, none) {}

  // Lines `first` to `end` cross the texels from `texel` on. A run only begins after an open texel.
  void meet(std::size_t first, std::size_t end, std::uint16_t const* texel, std::uint16_t solid,
            std::vector<std::size_t>& counts) {
    for (std::size_t line = first; line < end; ++line, ++texel) {
      int& length = lengths_[line];
      if (*texel >= solid) {
        ++length;
        continue;
      }
      if (length > 0) ++counts[static_cast<std::size_t>(length)];
      length = closing_ ? none : 0;
    }
  }

  // From now on, runs only end and none begins.
  void close() {
    closing_ = true;
    for (int& length : lengths_) {
      if (length == 0) length = none;
    }
  }
  bool all_ended() const {
    return std::none_of(lengths_.begin(), lengths_.end(), [](int length) { return length > 0; });
  }

 private:
  // So far below 0 that it never becomes a run in any raster.
  static constexpr int none = std::numeric_limits<int>::min() / 2;

  std::vector<int> lengths_;
  bool closing_ = false;
};

}  // namespace

SolidRuns::SolidRuns(std::span<std::uint16_t const> texels, int columns, int rows,
                     std::uint16_t solid)
    : columns_(static_cast<std::size_t>(columns)),
      rows_(static_cast<std::size_t>(rows)),
      along_rows_(across_rows(texels, solid)),
      along_columns_(across_columns(texels, solid, 0)),
      rising_(across_columns(texels, solid, 1)),
      falling_(across_columns(texels, solid, -1)) {}

double SolidRuns::shortest_along_diagonals(double share) const {
  return std::min(shortest(rising_, share), shortest(falling_, share));
}

double SolidRuns::shortest(Counts const& counts, double share) {
  std::size_t const all = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  std::size_t shorter = 0;
  for (std::size_t length = 0; length < counts.size(); ++length) {
    shorter += counts[length];
    if (static_cast<double>(shorter) > share * static_cast<double>(all)) {
      return static_cast<double>(length);
    }
  }
  return std::numeric_limits<double>::infinity();
}

SolidRuns::Counts SolidRuns::across_rows(std::span<std::uint16_t const> texels,
                                         std::uint16_t solid) const {
  Counts counts(columns_ + 1, 0);
  for (std::size_t row = 0; row < rows_; ++row) {
    auto const line = texels.subspan(row * columns_, columns_);
    auto const is_open = [=](std::uint16_t texel) { return texel < solid; };
    auto const first = std::find_if(line.begin(), line.end(), is_open);
    if (first == line.end()) continue;
    std::size_t run = 0;
    auto const end_run = [&] {
      if (run > 0) ++counts[run];
      run = 0;
    };
    for (auto texel = first; texel != line.end(); ++texel) {
      if (is_open(*texel)) {
        end_run();
      } else {
        ++run;
      }
    }
    run += static_cast<std::size_t>(first - line.begin());
    end_run();
  }
  return counts;
}

SolidRuns::Counts SolidRuns::across_columns(std::span<std::uint16_t const> texels,
                                            std::uint16_t solid, int du) const {
  // As many rows as a diagonal has columns, so that each line crosses everything on its way.
  std::size_t const copies = du == 0 ? 1 : (columns_ + rows_ - 1) / rows_;
  std::size_t const most = copies * rows_;
  Counts counts(2 * most + 1, 0);
  RunLengths lines(columns_);
  for (std::size_t step = 0; step < 2 * most; ++step) {
    if (step == most) lines.close();
    if (step >= most && lines.all_ended()) break;
    std::uint16_t const* const texel = texels.data() + step % rows_ * columns_;
    // The line that crosses the first texel of the row.
    std::size_t const turn = step % columns_;
    std::size_t const first = du == 0 || turn == 0 ? 0 : du > 0 ? columns_ - turn : turn;
    lines.meet(first, columns_, texel, solid, counts);
    lines.meet(0, first, texel + (columns_ - first), solid, counts);
  }
  return counts;
}

}  // namespace gpu_shading
