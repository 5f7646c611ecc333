#include "sun/sampling/fraction_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gpu_shading {
namespace {

// Less than any error of rendering.
constexpr double same_within = 1e-4;

struct Shared {
  double value;
  std::size_t samples;
};

// Values that at least five samples share, the most frequent first.
std::vector<Shared> shared_values(std::vector<double> const& ascending) {
  constexpr std::size_t min_samples = 5;
  std::vector<Shared> shared;
  for (auto from = ascending.begin(); from != ascending.end();) {
    auto const to = std::upper_bound(from, ascending.end(), *from + same_within);
    auto const samples = static_cast<std::size_t>(to - from);
    if (samples >= min_samples) shared.push_back({0.5 * (*from + *(to - 1)), samples});
    from = to;
  }
  std::ranges::stable_sort(shared, std::ranges::greater{}, &Shared::samples);
  return shared;
}

}  // namespace

std::vector<double> fraction_levels(std::span<double const> fractions) {
  constexpr std::size_t max_levels = 7;
  // Levels closer together would part differences that do not matter.
  constexpr double min_distance = 5e-3;
  std::vector<double> ascending(fractions.begin(), fractions.end());
  std::ranges::sort(ascending);
  std::vector<double> levels{0.0, 1.0};
  for (auto const& [value, samples] : shared_values(ascending)) {
    bool const apart = std::ranges::all_of(
        levels, [value = value](double level) { return std::abs(level - value) > min_distance; });
    if (apart && levels.size() < max_levels) levels.push_back(value);
  }
  std::ranges::sort(levels);
  bool const all_above = levels.size() > 2 && ascending.front() > levels[1] - same_within;
  if (all_above) levels.erase(levels.begin());
  return levels;
}

}  // namespace gpu_shading
