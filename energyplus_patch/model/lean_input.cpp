#include "model/lean_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <utility>

#include "base/text.h"
#include "gpu_shading/error.h"
#include "model/geometry_rules.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::array<std::pair<std::string_view, Attachment>, 3> detailed_types{{
    {"Shading:Site:Detailed", Attachment::site},
    {"Shading:Building:Detailed", Attachment::building},
    {"Shading:Zone:Detailed", Attachment::zone},
}};

std::optional<Attachment> attachment_of(InputObject const& object) {
  for (auto const& [type, attachment] : detailed_types) {
    if (object.type == type) return attachment;
  }
  return std::nullopt;
}

// Types that need the surfaces, or that change the meaning of their vertices, and why.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> forbidding_types{{
    {"Daylighting:Controls", "daylighting needs the surfaces themselves"},
    {"Daylighting:DELight:ComplexFenestration", "daylighting needs the surfaces themselves"},
    {"DaylightingDevice:Tubular", "daylighting needs the surfaces themselves"},
    {"DaylightingDevice:Shelf", "daylighting needs the surfaces themselves"},
    {"DaylightingDevice:LightWell", "daylighting needs the surfaces themselves"},
    {"Construction:ComplexFenestrationState", "its rays need the surfaces themselves"},
    {"PythonPlugin:Instance", "it may ask for any surface"},
    {"GeometryTransform", "it changes vertices in ways that lean input does not support"},
}};

// Why no surface may be left out, or "".
std::string reason_against(std::vector<InputObject> const& objects, ShadingInput const& input) {
  if (input.reflections) return "Building: Solar Distribution asks for reflections";
  if (input.all_shading_wanted) {
    return "ShadowCalculation: Output External Shading Calculation Results is Yes";
  }
  for (auto const& object : objects) {
    auto const found = std::find_if(forbidding_types.begin(), forbidding_types.end(),
                                    [&](auto const& entry) { return entry.first == object.type; });
    if (found != forbidding_types.end()) {
      return fmt::format("{}: {}", object.title(), found->second);
    }
    if (object.type == "Compliance:Building" &&
        !object["building_rotation_for_appendix_g"].empty()) {
      return "Compliance:Building: Building Rotation for Appendix G rotates the surfaces";
    }
  }
  return {};
}

// The vertices of the object; empty if they are invalid.
std::optional<Ring> vertices_of(InputObject const& object) {
  auto const count = object.list.size() / 3;
  if (count < 3 || object.list.size() % 3 != 0) return std::nullopt;
  auto const& given = object["number_of_vertices"];
  if (!given.empty() && !same_name(given, "autocalculate")) {
    auto const number = parse_number(given);
    if (!number || *number != static_cast<double>(count)) return std::nullopt;
  }
  Ring ring;
  ring.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 vertex;
    for (int axis = 0; axis < 3; ++axis) {
      auto const value = parse_number(object.list[3 * i + static_cast<std::size_t>(axis)]);
      if (!value) return std::nullopt;
      vertex[axis] = *value;
    }
    ring.push_back(vertex);
  }
  return ring;
}

std::optional<GeometryRules::Zone> zone_of(InputObject const& object, ShadingInput const& input,
                                           GeometryRules const& rules) {
  auto const name = input.zone_of.find(input.base_surface(upper(object["base_surface_name"])));
  if (name == input.zone_of.end()) return std::nullopt;
  auto const zone = rules.zones.find(name->second);
  return zone == rules.zones.end() ? std::nullopt : std::optional(zone->second);
}

std::optional<Ring> outline_of(InputObject const& object, ShadingInput const& input,
                               GeometryRules const& rules) {
  auto vertices = vertices_of(object);
  if (!vertices) return std::nullopt;
  auto const attachment = *attachment_of(object);
  GeometryRules::Zone zone;
  if (attachment == Attachment::zone) {
    auto const found = zone_of(object, input, rules);
    if (!found) return std::nullopt;
    zone = *found;
  }
  return to_world(rules, std::move(*vertices), attachment, zone);
}

// Names of detailed shading surfaces that only one shading object has.
Names find_candidates(std::vector<InputObject> const& objects) {
  Names all;
  Names twice;
  Names candidates;
  for (auto const& object : objects) {
    if (!object.type.starts_with("Shading:") || object.name.empty()) continue;
    auto const name = upper(object.name);
    if (!all.insert(name).second) twice.insert(name);
    if (attachment_of(object)) candidates.insert(name);
  }
  for (auto const& name : twice) candidates.erase(name);
  return candidates;
}

bool is_surface_output(InputObject const& object) {
  constexpr std::string_view start = "Surface ";
  auto const& variable = object["variable_name"];
  return object.type == "Output:Variable" && variable.size() > start.size() &&
         same_name(std::string_view(variable).substr(0, start.size()), start);
}

// EnergyPlus treats the key of an output as a regular expression if it looks like one.
void find_outputs(std::vector<InputObject> const& objects, Names const& names, Mentions& mentions) {
  for (auto const& object : objects) {
    auto const& key = object["key_value"];
    if (!is_surface_output(object) || key == "*" ||
        key.find_first_of("^$.|?*+()[]{}\\") == std::string::npos) {
      continue;
    }
    try {
      std::regex const pattern(key, std::regex::icase | std::regex::optimize);
      for (auto const& name : names) {
        if (std::regex_match(name, pattern)) mentions.try_emplace(name, object.type);
      }
    } catch (std::regex_error const&) {
      throw Error(
          fmt::format("{}: Key Value is \"{}\", which is not a valid pattern", object.type, key));
    }
  }
}

// Describes outputs that lack the removed surfaces, or "".
std::string poorer_outputs(std::vector<InputObject> const& objects) {
  bool rows = false;
  bool drawing = false;
  for (auto const& object : objects) {
    auto const& key = object["key_value"];
    rows = rows || (is_surface_output(object) && (key.empty() || key == "*"));
    drawing = drawing || object.type == "Output:Surfaces:Drawing";
  }
  if (!rows && !drawing) return {};
  return fmt::format("; {} show placeholders instead", !drawing ? "outputs with key *"
                                                       : !rows  ? "drawings"
                                                               : "outputs with key * and drawings");
}

Names all_surfaces(ShadingInput const& input) {
  Names names;
  for (auto const& [name, zone] : input.zone_of) names.insert(name);
  for (auto const& [name, base] : input.base_of) names.insert(name);
  for (auto const& [name, surface] : input.shading_surfaces) names.insert(name);
  return names;
}

std::string surfaces(std::size_t count) {
  return fmt::format("{} shading surface{}", count, count == 1 ? "" : "s");
}

std::string describe(LeanInput const& lean, Names const& candidates, Mentions const& mentions,
                     std::vector<InputObject> const& objects) {
  auto text = fmt::format("lean input: {} hidden from EnergyPlus, but still rendered",
                          surfaces(lean.left_out.size()));
  if (candidates.size() > lean.left_out.size()) {
    text += fmt::format("; {} kept", candidates.size() - lean.left_out.size());
    if (!mentions.empty()) {
      auto const first =
          std::min_element(mentions.begin(), mentions.end(),
                           [](auto const& a, auto const& b) { return a.first < b.first; });
      text += fmt::format(" (such as {}, which {} names)", first->first, first->second);
    }
  }
  return text + poorer_outputs(objects);
}

LeanInput plan(std::vector<InputObject> const& objects, ShadingInput const& input,
               Names const& candidates, MentionFinder const& find_mentions) {
  auto const rules = read_geometry_rules(objects);
  auto mentions = find_mentions(candidates);
  find_outputs(objects, candidates, mentions);
  LeanInput lean;
  std::vector<std::string> schedules;
  Names known_schedules;
  for (auto const& object : objects) {
    if (!attachment_of(object)) continue;
    auto name = upper(object.name);
    if (!candidates.contains(name) || mentions.contains(name)) continue;
    auto outline = outline_of(object, input, rules);
    if (!outline) continue;
    auto const& schedule = object["transmittance_schedule_name"];
    if (!schedule.empty() && known_schedules.insert(upper(schedule)).second) {
      schedules.push_back(schedule);
    }
    lean.left_out.insert(name);
    Surface caster;
    caster.name = std::move(name);
    caster.polygon.outline = std::move(*outline);
    lean.casters.push_back(std::move(caster));
  }
  lean.placeholders = make_placeholders(schedules, all_surfaces(input));
  lean.remark = describe(lean, candidates, mentions, objects);
  return lean;
}

}  // namespace

bool LeanInput::is_placeholder(std::string const& surface) const {
  return std::any_of(placeholders.begin(), placeholders.end(),
                     [&](Placeholder const& each) { return each.name == surface; });
}

LeanInput plan_lean_input(std::vector<InputObject> const& objects, ShadingInput const& input,
                          Options const& options, MentionFinder const& find_mentions) {
  if (options.mode == Mode::off || options.lean == Lean::off) return {};
  bool const forced = options.lean == Lean::on;
  auto const candidates = find_candidates(objects);
  if (!forced && candidates.size() < fewest_left_out) return {};
  LeanInput none;
  try {
    auto const reason = reason_against(objects, input);
    if (!reason.empty()) throw Error(reason);
    auto lean = plan(objects, input, candidates, find_mentions);
    if (lean.left_out.size() >= (forced ? 1 : fewest_left_out)) return lean;
    if (forced) none.remark = "lean input: no shading surface can be hidden from EnergyPlus";
  } catch (Error const& error) {
    none.remark = fmt::format("lean input is off: {}", error.what());
  }
  return none;
}

void ensure_placeholders(LeanInput& lean, ShadingInput const& input) {
  if (lean.placeholders.empty()) lean.placeholders = make_placeholders({}, all_surfaces(input));
}

}  // namespace gpu_shading::energyplus
