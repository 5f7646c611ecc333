#include "site/left_out.h"

#include <algorithm>

#include "input/name_pattern.h"

namespace gpu_shading::energyplus {

std::vector<std::string> read_left_out(InputObject const& object) {
  auto patterns = object.list;
  std::erase(patterns, "");
  return patterns;
}

bool is_left_out(std::vector<std::string> const& patterns, std::string_view name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](std::string const& pattern) { return matches(pattern, name); });
}

}  // namespace gpu_shading::energyplus
