#include "model/ray_warnings.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "base/text.h"
#include "extensions/extension_fields.h"

namespace gpu_shading::energyplus {
namespace {

// "A, B, C and 4 more", of the objects of a type; "" if there is none.
std::string names_of(std::vector<InputObject> const& objects, std::string_view type) {
  constexpr std::size_t most = 5;
  std::string names;
  std::size_t count = 0;
  for (auto const& object : objects) {
    if (object.type != type || ++count > most) continue;
    if (!names.empty()) names += ", ";
    names += printable(object.name);
  }
  if (count > most) names += fmt::format(" and {} more", count - most);
  return names;
}

// The parts of EnergyPlus in this model that trace rays to shading surfaces, as a warning begins.
std::vector<std::string> users_of_rays(std::vector<InputObject> const& objects,
                                       ShadingInput const& input) {
  struct User {
    std::string_view what;
    std::string_view type;
  };
  constexpr std::array<User, 5> users{{
      {"daylighting", "Daylighting:Controls"},
      {"daylighting", "Daylighting:DELight:ComplexFenestration"},
      {"daylighting", "DaylightingDevice:Tubular"},
      {"daylighting", "DaylightingDevice:Shelf"},
      {"complex fenestration", "Construction:ComplexFenestrationState"},
  }};
  std::vector<std::string> found;
  std::string_view last;
  for (auto const& [what, type] : users) {
    if (what == last) continue;
    auto const names = names_of(objects, type);
    if (names.empty()) continue;
    found.push_back(fmt::format("{} ({} {})", what, type, names));
    last = what;
  }
  if (input.reflections) found.push_back("solar reflections (Building, Solar Distribution)");
  return found;
}

}  // namespace

std::vector<std::string> warn_of_rays(std::vector<InputObject> const& objects,
                                      ShadingInput const& input) {
  struct Shade {
    std::string_view type;
    bool seen;
  };
  constexpr std::array<Shade, 4> shades{{
      {extension::transparent_shade::type, true},
      {extension::perforated_screen::type, true},
      {extension::geometry::type, false},
      {extension::site_context::type, false},
  }};
  std::vector<std::string> warnings;
  for (auto const& user : users_of_rays(objects, input)) {
    for (auto const& [type, seen] : shades) {
      auto const names = names_of(objects, type);
      if (names.empty()) continue;
      warnings.push_back(
          seen ? fmt::format("rays of {} take the surfaces of {} {} as opaque, but for their "
                             "Transmittance Schedules",
                             user, type, names)
               : fmt::format("rays of {} do not see {} {}", user, type, names));
    }
  }
  return warnings;
}

}  // namespace gpu_shading::energyplus
