#include "model/input/surrounding_groups.h"

#include <algorithm>

#include "model/extensions/extension_fields.h"
#include "model/idf/fields.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {

namespace field = extension::surrounding_group;

std::vector<SurroundingGroup> read_surrounding_groups(std::vector<InputObject> const& objects) {
  std::vector<SurroundingGroup> groups;
  for (auto const& object : objects) {
    if (object.type != field::type) continue;
    naming(object.where(), [&] {
      groups.push_back({object.name, read(object, field::surface_name),
                        read(object, field::temperature_schedule_name), object.where()});
    });
  }
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
  return std::any_of(objects.begin(), objects.end(), [](InputObject const& object) {
    return object.type == local_environment && upper(object.name).starts_with(views_of);
  });
}

}  // namespace gpu_shading::energyplus
