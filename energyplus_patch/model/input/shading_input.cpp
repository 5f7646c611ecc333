#include "model/input/shading_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/named_entries.h"
#include "platform/naming.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

bool is_shading(std::string_view type) {
  return type.starts_with("Shading:") && !type.starts_with("ShadingProperty");
}

bool yes(InputObject const& object, std::string const& field) {
  return same_name(object[field], "Yes");
}

bool is_exterior(InputObject const& object) {
  for (std::string_view const kind :
       {":Adiabatic", ":Underground", ":Interzone", ":GroundContact"}) {
    if (object.type.ends_with(kind)) return false;
  }
  auto const& boundary = object["outside_boundary_condition"];
  return boundary.empty() || same_name(boundary, "Outdoors") ||
         same_name(boundary, "OtherSideConditionsModel");
}

// Objects that decide on shading and whose fields moved or were renamed since EnergyPlus 9. Source:
// EnergyPlus's src/Transition/CreateNewIDFUsingRulesV9_3_0.f90, case SHADOWCALCULATION, and
// InputRulesFiles/Rules23-1-0-to-23-2-0.md: External Shading Fraction Schedule Name became Sunlit
// Fraction Schedule Name, at the same position of an IDF and with the same meaning, so that only
// epJSON differs.
struct Change {
  ChangedObject object;
  std::string_view renamed;  // the field's former name in epJSON; "": all fields moved
};
constexpr std::array<Change, 2> changes{{
    {{"ShadowCalculation", "9.3"}, ""},
    {{"SurfaceProperty:LocalEnvironment", "23.2"}, "external_shading_fraction_schedule_name"},
}};

bool applies(Change const& change, InputObject const& object) {
  if (object.type != change.object.type) return false;
  if (!change.renamed.empty()) return !object[change.renamed].empty();
  return std::ranges::any_of(object.fields,
                             [](auto const& field) { return !field.second.empty(); });
}

// The leading "major.minor" of a version, as numbers.
std::pair<int, int> release(std::string_view version) {
  std::pair<int, int> numbers{0, 0};
  auto const end = version.data() + version.size();
  auto const [dot, error] = std::from_chars(version.data(), end, numbers.first);
  if (error == std::errc() && dot != end) std::from_chars(dot + 1, end, numbers.second);
  return numbers;
}

std::string text_of(std::pair<int, int> const& release) {
  return fmt::format("{}.{}", release.first, release.second);
}

void read_shadow_calculation(InputObject const& object, ShadingInput& input) {
  input.shading_method = object["shading_calculation_method"];
  // Tools also write a resolution with PolygonClipping, where it means nothing.
  auto const& text = object["pixel_counting_resolution"];
  if (!text.empty() && same_name(input.shading_method, "PixelCounting")) {
    constexpr int max_resolution = 65536;
    auto const value = parse_number(text);
    if (!value || *value < 1.0 || *value > max_resolution) {
      throw Error(fmt::format("Pixel Counting Resolution is {}, expected a number from 1 to {}",
                              in_quotes(text), max_resolution));
    }
    input.pixel_counting_resolution = static_cast<int>(*value);
  }
  input.every_timestep =
      same_name(object["shading_calculation_update_frequency_method"], "Timestep");
  constexpr double min_days = 1.0;
  constexpr double max_days = 366.0;
  auto const days = parse_number(object["shading_calculation_update_frequency"]);
  if (days) {
    input.update_days = static_cast<int>(std::clamp(*days, min_days, max_days));
  }
  input.detailed_sky =
      same_name(object["sky_diffuse_modeling_algorithm"], "DetailedSkyDiffuseModeling");
  input.disable_within_groups = yes(object, "disable_self_shading_within_shading_zone_groups");
  input.disable_between_groups =
      yes(object, "disable_self_shading_from_shading_zone_groups_to_other_zones");
  if (yes(object, "output_external_shading_calculation_results")) input.all_shading_wanted = true;
  for (auto const& group : object.list) {
    if (!group.empty()) input.shading_zone_groups.push_back(upper(group));
  }
}

// EnergyPlus would end by a segmentation fault.
void check_zone_groups(ShadingInput const& input) {
  if (!input.disable_within_groups && !input.disable_between_groups) return;
  for (std::size_t i = 0; i < input.shading_zone_groups.size(); ++i) {
    auto const& group = input.shading_zone_groups[i];
    if (input.zone_lists.contains(group)) continue;
    std::vector<std::string> names;
    for (auto const& [name, zones] : input.zone_lists) names.push_back(name);
    throw Error(fmt::format(
        "Shading Zone Group {} ZoneList Name is {}, which no ZoneList of the model has{}", i + 1,
        in_quotes(group), did_you_mean(group, names)));
  }
}

void read_shading_surface(InputObject const& object, ShadingInput& input) {
  ShadingInput::ShadingSurface surface;
  surface.type = object.type;
  surface.transmittance_schedule = upper(object["transmittance_schedule_name"]);
  auto const name = upper(object.name);
  if (object.type.starts_with("Shading:Fin")) {
    // EnergyPlus creates two surfaces from one object, with these names.
    input.shading_surfaces[name + " Left"] = surface;
    input.shading_surfaces[name + " Right"] = surface;
  } else {
    input.shading_surfaces[name] = surface;
  }
}

// A share of a ShadingProperty:Reflectance, 0 .. 1. EnergyPlus itself refuses other values.
double share(InputObject const& object, std::string_view field, double blank) {
  return std::clamp(parse_number(object[field]).value_or(blank), 0.0, 1.0);
}

// The properties may stand before their surface.
void read_reflectances(std::vector<InputObject> const& objects, ShadingInput& input) {
  for (auto const& object : objects) {
    if (object.type != "ShadingProperty:Reflectance") continue;
    auto const surface = input.shading_surfaces.find(upper(object["shading_surface_name"]));
    if (surface == input.shading_surfaces.end()) continue;
    surface->second.reflectance =
        share(object, "diffuse_solar_reflectance_of_unglazed_part_of_shading_surface", 0.2);
    surface->second.visible_reflectance =
        share(object, "diffuse_visible_reflectance_of_unglazed_part_of_shading_surface", 0.2);
    surface->second.glazed = share(object, "fraction_of_shading_surface_that_is_glazed", 0.0);
    surface->second.glazing = upper(object["glazing_construction_name"]);
  }
}

// Surfaces that outputs and EMS sensors name.
struct Named {
  std::set<std::string> names;  // upper case
  std::vector<std::regex> patterns;

  bool contains(std::string const& name) const {
    return names.contains(upper(name)) ||
           std::ranges::any_of(patterns, [&](std::regex const& pattern) {
             return std::regex_match(name, pattern);
           });
  }
};

// Whether the values of an output variable depend on the sunlit fraction of its surface.
bool depends_on_shading(std::string_view variable) {
  // EnergyPlus reports these of shading surfaces too.
  constexpr std::array<std::string_view, 4> starts{
      "Surface Outside Face Sunlit ", "Surface Outside Face Incident ", "Surface Anisotropic Sky ",
      "Debug Surface Solar Shading Model "};
  return std::ranges::any_of(starts, [&](std::string_view start) {
    return same_name(variable.substr(0, start.size()), start);
  });
}

// Tables have rows for all surfaces.
void read_table(InputObject const& object, ShadingInput& input) {
  input.all_surfaces_shown =
      input.all_surfaces_shown || std::ranges::any_of(object.list, depends_on_shading);
}

// EnergyPlus treats the key of an output as a regular expression if it looks like one.
void read_output(InputObject const& object, ShadingInput& input, Named& named) {
  auto const& key = object["key_value"];
  if (key.empty() || key == "*") {
    input.all_surfaces_shown =
        input.all_surfaces_shown || depends_on_shading(object["variable_name"]);
  } else if (key.find_first_of("^$.|?*+()[]{}\\") == std::string::npos) {
    named.names.insert(upper(key));
  } else if (is_surface_output(object)) {
    try {
      named.patterns.emplace_back(key, std::regex::icase | std::regex::optimize);
    } catch (std::regex_error const&) {
      input.unreadable_key =
          fmt::format("{}: Key Value is \"{}\", which is not a valid pattern", object.type, key);
      input.all_shading_wanted = true;
    }
    named.names.insert(upper(key));
  }
}

constexpr std::string_view mirrored_prefix = "Mir-";

bool matches_key(std::string const& pattern, std::map<std::string, std::string> const& names) {
  bool found = false;
  for_each_match(names, pattern, [&](auto const&) { found = true; });
  return found;
}

}  // namespace

Error no_shading_surface(std::string_view field, std::string const& pattern,
                         ShadingInput const& input) {
  auto const refused = [&](std::string_view what) {
    return Error(fmt::format("{} is {}, which {}", field, in_quotes(pattern), what));
  };
  for (auto const& [names, kind] :
       {std::pair(&input.base_of, "window or door"), {&input.zone_of, "wall, floor or roof"}}) {
    if (!matches_key(pattern, *names)) continue;
    return refused(fmt::format("matches a {}: expected a shading surface (Shading:...)", kind));
  }
  std::vector<std::string> names;
  for (auto const& [name, surface] : input.shading_surfaces) names.push_back(name);
  return refused("no shading surface of the model matches" + did_you_mean(pattern, names));
}

std::string mirrored_name(std::string const& shading_surface) {
  return std::string(mirrored_prefix) + shading_surface;
}

bool is_mirrored(std::string const& surface) { return surface.starts_with(mirrored_prefix); }

bool is_surface_output(InputObject const& object) {
  constexpr std::string_view start = "Surface ";
  auto const& variable = object["variable_name"];
  return object.type == "Output:Variable" && variable.size() > start.size() &&
         same_name(std::string_view(variable).substr(0, start.size()), start);
}

Casting ShadingInput::casting(std::string const& surface) const {
  if (base_of.contains(surface) || not_exterior.contains(surface)) return Casting::never;
  return zone_of.contains(surface) ? Casting::turned_away : Casting::always;
}

bool ShadingInput::mirrored_shown() const {
  return all_surfaces_shown || !unreadable_key.empty() ||
         std::ranges::any_of(wanted_shading, is_mirrored);
}

std::string ShadingInput::base_surface(std::string const& surface) const {
  auto const base = base_of.find(surface);
  return base == base_of.end() ? surface : base->second;
}

bool ShadingInput::receives(std::string const& surface) const {
  if (shading_surfaces.contains(surface) || is_mirrored(surface)) return wants(surface);
  return !not_exterior.contains(base_surface(surface));
}

ShadingInput read_shading_input(std::vector<InputObject> const& objects) {
  ShadingInput input;
  Named named;
  InputObject const* shadow_calculation = nullptr;
  for (auto const& object : objects) {
    for (auto const& change : changes) {
      if (applies(change, object)) input.changed_objects.push_back(change.object);
    }
    if (object.type == "Version") {
      input.version = object["version_identifier"];
    } else if (object.type == "Building") {
      auto const distribution = upper(object["solar_distribution"]);
      input.minimal_shadowing = distribution == "MINIMALSHADOWING";
      input.reflections = distribution.ends_with("WITHREFLECTIONS");
    } else if (object.type == "ShadowCalculation") {
      // EnergyPlus uses the first one and warns about the others.
      if (shadow_calculation != nullptr) continue;
      shadow_calculation = &object;
      naming(object.where(), [&] { read_shadow_calculation(object, input); });
    } else if (object.type == "ZoneList") {
      auto& zones = input.zone_lists[upper(object.name)];
      for (auto const& zone : object.list) {
        if (!zone.empty()) zones.insert(upper(zone));
      }
    } else if (is_shading(object.type)) {
      read_shading_surface(object, input);
    } else if (object.fields.contains("zone_name")) {
      input.zone_of[upper(object.name)] = upper(object["zone_name"]);
      if (!is_exterior(object)) input.not_exterior.insert(upper(object.name));
    } else if (object.fields.contains("building_surface_name")) {
      input.base_of[upper(object.name)] = upper(object["building_surface_name"]);
    } else if (object.fields.contains("surface_name") && !is_extension(object.type)) {
      named.names.insert(upper(object["surface_name"]));
    } else if (object.type == "DaylightingDevice:Shelf") {
      named.names.insert(upper(object["outside_shelf_name"]));
    } else if (object.type == "Output:Variable" || object.type == "Output:Table:TimeBins") {
      read_output(object, input, named);
    } else if (object.type == "Output:Table:Monthly" || object.type == "Output:Table:Annual") {
      read_table(object, input);
    } else if (object.type == "EnergyManagementSystem:Actuator") {
      input.actuated.insert(upper(object["actuated_component_unique_name"]));
    } else if (object.type == "EnergyManagementSystem:Sensor") {
      named.names.insert(upper(object["output_variable_or_output_meter_index_key_name"]));
    }
  }
  if (shadow_calculation != nullptr) {
    naming(shadow_calculation->where(), [&] { check_zone_groups(input); });
  }
  read_reflectances(objects, input);
  for (auto const& [name, surface] : input.shading_surfaces) {
    for (auto const& each : {name, mirrored_name(name)}) {
      if (named.contains(each)) input.wanted_shading.insert(each);
    }
  }
  return input;
}

std::string check_supported(ShadingInput const& input, std::string_view file,
                            Release const& energyplus) {
  if (same_name(input.shading_method, "Scheduled") || same_name(input.shading_method, "Imported")) {
    throw Error(fmt::format(
        "{}: ShadowCalculation: Shading Calculation Method is {}: this model brings its own sunlit "
        "fractions, which --gpu-shading would replace; run it without the flag",
        file, input.shading_method));
  }
  auto const own = release(energyplus.version);
  auto const given = input.version.empty() ? own : release(input.version);
  for (auto const& [type, changed] : input.changed_objects) {
    if (given >= release(changed) || own < release(changed)) continue;
    throw Error(fmt::format(
        "{}: {}: its fields changed in EnergyPlus {}, and the model's Version is {}: update the "
        "model with {}",
        file, type, changed, printable(input.version), energyplus.updater));
  }
  if (given == own) return {};
  bool const older = given < own;
  return fmt::format(
      "{}: Version is {}, {} than this EnergyPlus, {}, which reads all fields as its own; {}", file,
      printable(input.version), older ? "older" : "newer", text_of(own),
      older ? fmt::format("to be sure, update the model with {}", energyplus.updater)
            : "to be sure, use that EnergyPlus");
}

}  // namespace gpu_shading::energyplus
