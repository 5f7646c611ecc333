#pragma once

#include <string>
#include <vector>

#include "model/idf/input_object.h"
#include "model/idf/mentions.h"
#include "model/input/shading_input.h"
#include "model/options/options.h"
#include "model/reflected_light_input.h"

namespace gpu_shading::energyplus {

// Whose reflected light EnergyPlus's surfaces get, and what follows.
struct ReflectedLightPlan {
  ReflectedLightInput input;  // without receivers: EnergyPlus's own
  std::vector<std::string> warnings;
  std::vector<std::string> remarks;
};

// The model, with the objects that are added to it.
struct ReflectingModel {
  std::vector<InputObject> const& objects;
  std::vector<InputObject> const& more;
  MentionFinder const& find_mentions;
};

// `can_be_set`: the schedules of the receivers can be made before EnergyPlus runs, or set while it
// does. Where this module's light replaces EnergyPlus's solar reflections, `shading` has none from
// then on.
ReflectedLightPlan plan_reflected_light(ReflectingModel const& model, Options const& options,
                                        bool can_be_set, ShadingInput& shading);

}  // namespace gpu_shading::energyplus
