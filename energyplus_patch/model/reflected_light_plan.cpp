#include "model/reflected_light_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "model/energyplus_rays.h"
#include "model/extensions/extension_fields.h"
#include "model/lean_input.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view distribution = "solar_distribution";
constexpr std::string_view with_reflections = "WithReflections";

bool is_shade(InputObject const& object) {
  constexpr std::array<std::string_view, 3> others{
      extension::settings::type, extension::surrounding_group::type, extension::pvmodules::type};
  return is_extension(object.type) && std::ranges::find(others, object.type) == others.end();
}

// The outputs of EnergyPlus's solar reflections that the model asks for.
std::vector<std::string> reflection_outputs(std::vector<InputObject> const& objects) {
  std::vector<std::string> found;
  for (auto const& object : objects) {
    auto const& variable = object["variable_name"];
    if (!matches("Surface Outside Face Incident * Surface Reflected Solar Radiation *", variable)) {
      continue;
    }
    if (std::ranges::find(found, variable) == found.end()) found.push_back(variable);
  }
  return found;
}

// Takes the word from the Building.
void leave_out_solar_reflections(std::vector<InputObject> const& objects, bool has_shades,
                                 ReflectedLightPlan& plan) {
  auto const building = std::ranges::find_if(objects, [](InputObject const& object) {
    return object.type == "Building" &&
           upper(object[distribution]).ends_with(upper(with_reflections));
  });
  if (building == objects.end()) return;
  auto const& given = (*building)[distribution];
  auto const left = given.substr(0, given.size() - with_reflections.size());
  plan.input.changes.push_back({"Building", "", position_of("Building", distribution), left});
  plan.remarks.push_back(fmt::format(
      "Building: Solar Distribution is {}: EnergyPlus reads {}, since reflected light is computed "
      "by this module{}",
      given, left,
      has_shades ? ""
                 : "; EnergyPlus's own reflections take too long with so many shading "
                   "surfaces"));
  constexpr std::size_t max_listed = 3;
  if (auto const outputs = reflection_outputs(objects); !outputs.empty()) {
    plan.warnings.push_back(fmt::format(
        "these outputs are 0, since all reflected light is in Surface Outside Face Incident Ground "
        "Diffuse Solar Radiation Rate per Area: {}",
        listed(outputs, max_listed)));
  }
  if (has_daylighting(objects)) {
    plan.warnings.emplace_back("daylighting has no reflections from outdoor surfaces");
  }
}

}  // namespace

ReflectedLightPlan plan_reflected_light(ReflectingModel const& model, Options const& options,
                                        bool can_be_set, ShadingInput& shading) {
  ReflectedLightPlan plan;
  if (options.mode == Mode::off) return plan;
  bool const has_shades = std::ranges::any_of(model.objects, is_shade);
  if (options.reflections == Reflections::energyplus) {
    if (has_shades) {
      // What reflects, to say by how much the light from the ground is too high.
      plan.input.light = read_reflectors(model.objects, shading);
      plan.input.light.undimmed = true;
      plan.warnings.emplace_back(
          "Reflections is energyplus: GPUShading objects neither reflect light nor dim that from "
          "the ground");
    }
    return plan;
  }
  bool const asked = options.reflections == Reflections::all;
  bool const wanted =
      asked || has_shades ||
      (shading.reflections && has_many_for_reflections(model.objects, options.lean));
  if (!wanted) return plan;
  if (!can_be_set) {
    if (asked || has_shades) {
      plan.warnings.emplace_back(
          "EnergyPlus's own light from the ground is used, which GPUShading objects do not dim: "
          "this method cannot replace it");
    }
    return plan;
  }
  plan.input = read_reflected_light(model.objects, model.more, shading, model.find_mentions);
  if (plan.input.light.receivers.empty()) return plan;
  plan.remarks = plan.input.remarks;
  if (shading.reflections) {
    leave_out_solar_reflections(model.objects, has_shades || asked, plan);
    shading.reflections = false;
  }
  return plan;
}

}  // namespace gpu_shading::energyplus
