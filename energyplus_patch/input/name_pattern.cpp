#include "input/name_pattern.h"

#include "input/input_object.h"

namespace gpu_shading::energyplus {

bool matches(std::string_view pattern, std::string_view name) {
  auto const star = pattern.find('*');
  if (star == std::string_view::npos) return same_name(pattern, name);
  if (name.size() < star || !same_name(pattern.substr(0, star), name.substr(0, star))) return false;
  auto const rest = pattern.substr(star + 1);
  for (std::size_t at = star; at <= name.size(); ++at) {
    if (matches(rest, name.substr(at))) return true;
  }
  return false;
}

}  // namespace gpu_shading::energyplus
