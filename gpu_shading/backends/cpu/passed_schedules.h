#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "backends/interface/view_backend.h"
#include "geometry/convex_area.h"
#include "view/pixel_rows.h"

namespace gpu_shading {

// Which scheduled shades the sun passes on its way to each pixel of a tile, or of some rows of it:
// a pixel holds the number of a combination of schedules, 0 where it passes none.
class PassedSchedules {
 public:
  // How often each schedule is passed, in the order of schedules.
  using Powers = std::vector<std::pair<int, int>>;

  // 0 everywhere.
  void start(int columns, int first_row, int end_row);

  // Through a shade over an area. Schedules must not decrease from call to call, so that each
  // combination has one number. Throws Error when there are too many combinations.
  void pass(ConvexArea const& area, int schedule);

  // Row after row, each from a whole word of a PixelMask on.
  std::span<std::uint32_t const> pixels() const { return numbers_.pixels(); }
  std::size_t stride() const { return numbers_.stride(); }

  std::size_t combinations() const { return combinations_.size(); }
  Powers powers(std::uint32_t combination) const;

 private:
  struct Combination {
    std::uint32_t before = 0;  // one shade less
    int schedule = -1;
  };

  std::uint32_t with(std::uint32_t combination, int schedule);

  PixelRows<std::uint32_t> numbers_;
  std::vector<Combination> combinations_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;  // by the one before and the schedule
};

// Sums luminance by combination.
class CombinationSums {
 public:
  explicit CombinationSums(std::size_t combinations) : sums_(combinations) {}

  void add(std::uint32_t combination, float luminance) {
    if (luminance == 0.0F) return;
    double& sum = sums_[combination];
    if (sum == 0.0) met_.push_back(combination);
    sum += static_cast<double>(luminance);
  }

  struct Sum {
    std::uint32_t combination;
    double luminance;
  };
  // Adds them to a list, and begins again at 0.
  void take(std::vector<Sum>& to);

 private:
  std::vector<double> sums_;
  std::vector<std::uint32_t> met_;
};

// Adds such sums of parts of a tile up, each part with combinations of its own numbers.
class ScheduledTotals {
 public:
  void add(PassedSchedules const& passed, std::span<CombinationSums::Sum const> sums);
  LuminanceSums result() const;

 private:
  std::map<PassedSchedules::Powers, double> totals_;
};

}  // namespace gpu_shading
