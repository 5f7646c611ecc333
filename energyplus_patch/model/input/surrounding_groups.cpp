#include "model/input/surrounding_groups.h"

#include <algorithm>

#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "model/idf/local_environment.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

namespace field = extension::surrounding_group;

std::vector<SurroundingGroup> read_surrounding_groups(std::vector<InputObject> const& objects) {
  std::vector<SurroundingGroup> groups;
  for_each_of(objects, field::type, [&](InputObject const& object) {
    groups.push_back({object.name, read(object, field::surface_name),
                      read(object, field::temperature_schedule_name), object.where()});
  });
  return groups;
}

Names surfaces_with_environment(std::vector<InputObject> const& objects) {
  Names names;
  for (auto const& object : objects) {
    if (object.type == local_environment) names.insert(upper(object["exterior_surface_name"]));
  }
  return names;
}

bool has_views(std::vector<InputObject> const& objects) {
  return std::ranges::any_of(objects, [](InputObject const& object) {
    return object.type == local_environment && upper(object.name).starts_with(views_of);
  });
}

}  // namespace gpu_shading::energyplus
