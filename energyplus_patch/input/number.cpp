#include "input/number.h"

#include <charconv>

namespace gpu_shading::energyplus {

std::optional<double> parse_number(std::string const& text) {
  // from_chars knows no plus sign.
  char const* const begin = text.data() + (text.starts_with('+') ? 1 : 0);
  char const* const end = text.data() + text.size();
  double value = 0.0;
  auto const [parsed, error] = std::from_chars(begin, end, value);
  if (error != std::errc{} || parsed != end) return std::nullopt;
  return value;
}

}  // namespace gpu_shading::energyplus
