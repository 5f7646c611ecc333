#include "platform/nearest_word.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace gpu_shading::energyplus {
namespace {

// The distance of Damerau and Levenshtein in its restricted form (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      std::size_t const replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view text, std::vector<std::string> const& words) {
  std::string_view nearest;
  std::size_t least = text.size() + 1;
  for (std::string_view const word : words) {
    auto const* const rest =
        std::mismatch(text.begin(), text.end(), word.begin(), word.end()).first;
    auto const same = static_cast<std::size_t>(rest - text.begin());
    // Of the letters from the first wrong one on, a third may be wrong.
    auto const allowed = std::max<std::size_t>(1, (text.size() - same + 2) / 3);
    auto const steps = distance(text.substr(same), word.substr(same));
    if (steps <= allowed && steps < least) {
      least = steps;
      nearest = word;
    }
  }
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

}  // namespace gpu_shading::energyplus
