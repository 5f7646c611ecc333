#include "model/site/left_out.h"

#include <algorithm>

#include "platform/text.h"

namespace gpu_shading::energyplus {

bool is_left_out(std::vector<std::string> const& patterns, std::string_view name) {
  return std::any_of(patterns.begin(), patterns.end(),
                     [&](std::string const& pattern) { return matches(pattern, name); });
}

}  // namespace gpu_shading::energyplus
