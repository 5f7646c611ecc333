
#include "model/energyplus_rays.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/extensions/extension_fields.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t max_listed = 5;

// The names of the objects of a type; "" if there are none.
std::string names_of(std::vector<InputObject> const& objects, std::string_view type) {
  std::vector<std::string> names;
  for (auto const& object : objects) {
    if (object.type == type) names.push_back(object.name);
  }
  return listed(names, max_listed);
}

// The parts of EnergyPlus in this model that trace rays to shading surfaces, as a warning begins.
struct User {
  enum class Kind { daylighting, complex_fenestration, reflections } kind;
  std::string text;
};
std::vector<User> users_of_rays(std::vector<InputObject> const& objects,
                                ShadingInput const& input) {
  std::vector<User> found;
  for (auto const& type : daylighting_types) {
    auto const names = names_of(objects, type);
    if (names.empty()) continue;
    found.push_back({User::Kind::daylighting, fmt::format("daylighting ({} {})", type, names)});
    break;
  }
  constexpr std::string_view complex = "Construction:ComplexFenestrationState";
  if (auto const names = names_of(objects, complex); !names.empty()) {
    found.push_back({User::Kind::complex_fenestration,
                     fmt::format("complex fenestration ({} {})", complex, names)});
  }
  if (input.reflections) {
    found.push_back({User::Kind::reflections, "solar reflections (Building, Solar Distribution)"});
  }
  return found;
}

}  // namespace

std::vector<std::string> warn_of_rays(
    std::vector<InputObject> const& objects, ShadingInput const& input,
    std::optional<std::vector<std::string>> const& opaque_to_daylight) {
  struct Shade {
    std::string_view type;
    bool seen;
  };
  constexpr std::array<Shade, 6> shades{{
      {extension::transparent_shade::type, true},
      {extension::perforated_screen::type, true},
      {extension::moving_shade::type, true},
      {extension::geometry::type, false},
      {extension::site_context::type, false},
      {extension::tree::type, false},
  }};
  std::vector<std::string> warnings;
  for (auto const& user : users_of_rays(objects, input)) {
    std::string_view const schedules =
        user.kind == User::Kind::reflections ? "" : ", except for their Transmittance Schedules";
    if (user.kind == User::Kind::daylighting && opaque_to_daylight) {
      if (opaque_to_daylight->empty()) continue;
      warnings.push_back(
          fmt::format("rays of {} treat surfaces that stay in EnergyPlus's input as opaque{}: {}",
                      user.text, schedules, listed(*opaque_to_daylight, max_listed)));
      continue;
    }
    for (auto const& [type, seen] : shades) {
      auto const names = names_of(objects, type);
      if (names.empty()) continue;
      if (type == extension::moving_shade::type) {
        warnings.push_back(fmt::format("rays of {} see the surfaces of {} {} as they are drawn",
                                       user.text, type, names));
        continue;
      }
      warnings.push_back(seen ? fmt::format("rays of {} treat the surfaces of {} {} as opaque{}",
                                            user.text, type, names, schedules)
                              : fmt::format("rays of {} do not see {} {}", user.text, type, names));
    }
  }
  return warnings;
}

bool has_daylighting(std::vector<InputObject> const& objects) {
  auto const& types = daylighting_types;
  return std::ranges::any_of(objects, [&](InputObject const& object) {
    return std::ranges::find(types, object.type) != types.end();
  });
}

bool daylighting_can_be_answered(std::vector<InputObject> const& objects) {
  return std::ranges::none_of(objects, [](InputObject const& object) {
    return object.type == "Daylighting:DELight:ComplexFenestration" ||
           object.type == "Construction:ComplexFenestrationState" ||
           (object.type == "Daylighting:Controls" &&
            same_name(object["daylighting_method"], "DElight"));
  });
}

}  // namespace gpu_shading::energyplus
