#pragma once

#include <string>
#include <string_view>

#include "platform/text.h"

namespace gpu_shading::energyplus {

// Calls `visit` for each entry of a sorted map, with upper-case names as its keys, whose name
// matches a pattern (as matches() does). Looks only at names that begin as the pattern does.
template <typename Map, typename Visit>
void for_each_match(Map const& map, std::string_view pattern, Visit const& visit) {
  auto const prefix = upper(pattern.substr(0, pattern.find('*')));
  for (auto entry = map.lower_bound(prefix); entry != map.end() && entry->first.starts_with(prefix);
       ++entry) {
    if (matches(pattern, entry->first)) visit(*entry);
  }
}

}  // namespace gpu_shading::energyplus
