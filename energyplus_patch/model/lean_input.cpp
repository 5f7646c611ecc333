#include "model/lean_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "gpu_shading/error.h"
#include "model/energyplus_rays.h"
#include "model/geometry_rules.h"
#include "model/shading_outlines.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// Types that need the surfaces, and why.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> forbidding_types{{
    {"Construction:ComplexFenestrationState", "its rays need the surfaces themselves"},
    {"PythonPlugin:Instance", "it may ask for any surface"},
}};
// Why an object needs the surfaces, or "".
std::string_view reason_of(InputObject const& object, bool daylighting_answered) {
  for (auto const& [type, reason] : forbidding_types) {
    if (object.type == type) return reason;
  }
  bool const daylighting =
      object.type == "DaylightingDevice:LightWell" ||
      std::ranges::find(daylighting_types, object.type) != daylighting_types.end();
  return daylighting && !daylighting_answered ? "daylighting needs the surfaces themselves" : "";
}

// Why no surface may be left out, or "".
std::string reason_against(std::vector<InputObject> const& objects, ShadingInput const& input,
                           EnergyPlusRays const& rays) {
  if (input.reflections) {
    return "Building: Solar Distribution asks for reflections";
  }
  if (!input.unreadable_key.empty()) return input.unreadable_key;
  if (input.all_shading_wanted) {
    return "ShadowCalculation: Output External Shading Calculation Results is Yes";
  }
  for (auto const& object : objects) {
    auto const reason = reason_of(object, rays.daylighting_answered);
    if (!reason.empty()) return fmt::format("{}: {}", object.title(), reason);
  }
  return reason_against_outlines(objects);
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
    if (is_detailed_shading(object)) candidates.insert(name);
  }
  for (auto const& name : twice) candidates.erase(name);
  return candidates;
}

// Outputs that name a surface or its mirrored copy, by a pattern too.
void add_outputs(ShadingInput const& input, Names const& names, Mentions& mentions) {
  for (auto const& name : names) {
    if (input.names(name) || input.names(mirrored_name(name))) {
      mentions.try_emplace(name, "Output:Variable");
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
      auto const first = std::ranges::min_element(mentions, {}, &Mentions::value_type::first);
      text += fmt::format(" (such as {}, which {} names)", first->first, first->second);
    }
  }
  return text + poorer_outputs(objects);
}

struct Candidate {
  InputObject const* object = nullptr;
  Outline outline;
};

// The surfaces that may be left out. `all`: if not, only those that EnergyPlus would simplify, and
// `wanted`.
std::vector<Candidate> outlines_of(std::vector<InputObject> const& objects,
                                   ShadingInput const& input, Names const& candidates, bool all,
                                   Names const& wanted) {
  auto const rules = read_geometry_rules(objects);
  std::vector<Candidate> found;
  for (auto const& object : objects) {
    auto const name = upper(object.name);
    if (!is_detailed_shading(object) || !candidates.contains(name)) continue;
    auto outline = outline_of(object, input, rules);
    if (!outline) continue;
    if (!all && !outline->simplified && !outline->degenerate && !wanted.contains(name)) continue;
    found.push_back({&object, std::move(*outline)});
  }
  return found;
}

LeanInput plan(std::vector<InputObject> const& objects, ShadingInput const& input,
               Names const& candidates, std::vector<Candidate> const& found,
               MentionFinder const& find_mentions) {
  auto mentions = find_mentions(candidates);
  add_outputs(input, candidates, mentions);
  LeanInput lean;
  std::vector<std::string> schedules;
  Names known_schedules;
  for (auto const& [object, outline] : found) {
    auto name = upper(object->name);
    if (mentions.contains(name)) continue;
    auto const& schedule = (*object)["transmittance_schedule_name"];
    if (!schedule.empty() && known_schedules.insert(upper(schedule)).second) {
      schedules.push_back(schedule);
    }
    lean.left_out.insert(name);
    Surface caster;
    caster.name = std::move(name);
    caster.polygon.outline = outline.vertices;
    lean.casters.push_back(std::move(caster));
  }
  lean.placeholders = make_placeholders(schedules, all_surfaces(input));
  lean.remark = describe(lean, candidates, mentions, objects);
  return lean;
}

}  // namespace

bool LeanInput::is_placeholder(std::string const& surface) const {
  return std::ranges::any_of(placeholders, [&](Placeholder const& each) {
    return each.name == surface || mirrored_name(each.name) == surface;
  });
}

bool has_many_for_reflections(std::vector<InputObject> const& objects, Lean lean) {
  if (lean == Lean::off) return false;
  return find_candidates(objects).size() >= (lean == Lean::on ? 1 : fewest_with_reflections);
}

LeanInput plan_lean_input(std::vector<InputObject> const& objects, ShadingInput const& input,
                          Options const& options, EnergyPlusRays const& rays,
                          MentionFinder const& find_mentions) {
  if (options.mode == Mode::off || options.lean == Lean::off) return {};
  bool const forced = options.lean == Lean::on;
  auto const candidates = find_candidates(objects);
  auto const fewest = input.reflections ? fewest_with_reflections : fewest_left_out;
  bool const all = forced || candidates.size() >= fewest;
  LeanInput none;
  try {
    auto const reason = reason_against(objects, input, rays);
    if (!reason.empty()) throw Error(reason);
    auto const found = outlines_of(objects, input, candidates, all, rays.transmitting);
    if (!all && found.empty()) return {};
    auto lean = plan(objects, input, candidates, found, find_mentions);
    if (lean.left_out.size() >= (forced || !all ? 1 : fewest)) return lean;
    if (forced) none.remark = "lean input: no shading surface can be hidden from EnergyPlus";
  } catch (Error const& error) {
    if (all) none.remark = fmt::format("lean input is off: {}", error.what());
  }
  return none;
}

void ensure_placeholders(LeanInput& lean, ShadingInput const& input) {
  if (lean.placeholders.empty()) lean.placeholders = make_placeholders({}, all_surfaces(input));
}

void add_sky_placeholder(LeanInput& lean, ShadingInput const& input) {
  auto taken = all_surfaces(input);
  for (auto const& placeholder : lean.placeholders) taken.insert(placeholder.name);
  lean.placeholders.push_back(make_sky_placeholder(taken));
  lean.follows_sky = true;
}

}  // namespace gpu_shading::energyplus
