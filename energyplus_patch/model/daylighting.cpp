#include "model/daylighting.h"

#include <algorithm>

#include "platform/text.h"

namespace gpu_shading::energyplus {

bool has_daylighting(std::vector<InputObject> const& objects) {
  auto const& types = daylighting_types;
  return std::any_of(objects.begin(), objects.end(), [&](InputObject const& object) {
    return std::find(types.begin(), types.end(), object.type) != types.end();
  });
}

bool daylighting_can_be_answered(std::vector<InputObject> const& objects) {
  return std::none_of(objects.begin(), objects.end(), [](InputObject const& object) {
    return object.type == "Daylighting:DELight:ComplexFenestration" ||
           object.type == "Construction:ComplexFenestrationState" ||
           (object.type == "Daylighting:Controls" &&
            same_name(object["daylighting_method"], "DElight"));
  });
}

}  // namespace gpu_shading::energyplus
