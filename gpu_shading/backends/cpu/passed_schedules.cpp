#include "backends/cpu/passed_schedules.h"

#include <fmt/format.h>

#include <algorithm>

#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

// Each takes some 60 bytes.
constexpr std::size_t max_combinations = std::size_t{1} << 22U;

}  // namespace

void PassedSchedules::start(int columns, int first_row, int end_row) {
  numbers_.start(columns, first_row, end_row, 0);
  combinations_.assign(1, {});
  known_.clear();
}

void PassedSchedules::pass(ConvexArea const& area, int schedule) {
  // Neighbouring pixels mostly have the same.
  std::uint32_t last = 0;
  std::uint32_t next = 0;
  numbers_.each_span(area, [&](int row, int first, int length) {
    std::uint32_t* const begin = numbers_.row(row).data() + first;
    std::for_each(begin, begin + length, [&](std::uint32_t& number) {
      if (next == 0 || number != last) {
        last = number;
        next = with(number, schedule);
      }
      number = next;
    });
  });
}

std::uint32_t PassedSchedules::with(std::uint32_t combination, int schedule) {
  auto const key = static_cast<std::uint64_t>(combination) << 32U |
                   static_cast<std::uint64_t>(static_cast<std::uint32_t>(schedule));
  auto const [entry, added] =
      known_.try_emplace(key, static_cast<std::uint32_t>(combinations_.size()));
  if (!added) return entry->second;
  if (combinations_.size() >= max_combinations) {
    throw Error(
        fmt::format("sees the sun through more than {} combinations of transmittance schedules; "
                    "let shades share "
                    "schedules",
                    max_combinations));
  }
  combinations_.push_back({combination, schedule});
  return entry->second;
}

PassedSchedules::Powers PassedSchedules::powers(std::uint32_t combination) const {
  Powers powers;
  for (; combination != 0; combination = combinations_[combination].before) {
    int const schedule = combinations_[combination].schedule;
    if (powers.empty() || powers.back().first != schedule) powers.emplace_back(schedule, 0);
    ++powers.back().second;
  }
  std::reverse(powers.begin(), powers.end());
  return powers;
}

void CombinationSums::take(std::vector<Sum>& to) {
  for (std::uint32_t const combination : met_) {
    to.push_back({combination, sums_[combination]});
    sums_[combination] = 0.0;
  }
  met_.clear();
}

void ScheduledTotals::add(PassedSchedules const& passed,
                          std::span<CombinationSums::Sum const> sums) {
  std::unordered_map<std::uint32_t, double*> totals;
  for (auto const& [combination, luminance] : sums) {
    double*& total = totals[combination];
    if (total == nullptr) total = &totals_[passed.powers(combination)];
    *total += luminance;
  }
}

LuminanceSums ScheduledTotals::result() const {
  LuminanceSums sums;
  for (auto const& [powers, total] : totals_) {
    if (powers.empty()) {
      sums.unscheduled = total;
    } else {
      sums.scheduled.push_back({powers, total});
    }
  }
  return sums;
}

}  // namespace gpu_shading
