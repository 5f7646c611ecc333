#include "model/transform_warning.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/geometry_rules.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

bool changes_shape(InputObject const& transform) {
  return parse_number(transform["current_aspect_ratio"]) !=
         parse_number(transform["new_aspect_ratio"]);
}

// The first by its name, or "".
std::string find_turned_zone(GeometryRules const& rules) {
  std::string first;
  for (auto const& [name, zone] : rules.zones) {
    if (zone.direction != 0.0 && (first.empty() || name < first)) first = name;
  }
  return first;
}

}  // namespace

std::string warn_of_transform(std::vector<InputObject> const& objects) {
  auto const transform =
      std::find_if(objects.begin(), objects.end(),
                   [](InputObject const& object) { return object.type == "GeometryTransform"; });
  if (transform == objects.end() || !changes_shape(*transform)) return {};
  auto const rules = read_geometry_rules(objects);
  if (!rules.relative) return {};  // EnergyPlus ignores it
  auto const turned = find_turned_zone(rules);
  return fmt::format(
      "{}: EnergyPlus moves vertices but keeps the areas{} of before, so sunlit fractions are "
      "wrong, with polygon clipping too; write the transformed vertices into the model instead",
      transform->where(),
      turned.empty()
          ? ""
          : fmt::format(" and, in turned zones such as {}, the azimuths", printable(turned)));
}

}  // namespace gpu_shading::energyplus
