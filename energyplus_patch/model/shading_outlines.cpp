#include "model/shading_outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::optional<Attachment> attachment_of(InputObject const& object) {
  constexpr std::array<std::pair<std::string_view, Attachment>, 8> detailed_types{{
      {"Shading:Site:Detailed", Attachment::site},
      {"Shading:Building:Detailed", Attachment::building},
      {"Shading:Zone:Detailed", Attachment::zone},
      {"BuildingSurface:Detailed", Attachment::zone},
      {"Wall:Detailed", Attachment::zone},
      {"RoofCeiling:Detailed", Attachment::zone},
      {"Floor:Detailed", Attachment::zone},
      {"FenestrationSurface:Detailed", Attachment::zone},
  }};
  for (auto const& [type, attachment] : detailed_types) {
    if (object.type == type) return attachment;
  }
  return std::nullopt;
}

std::optional<GeometryRules::Zone> zone_of(InputObject const& object, ShadingInput const& input,
                                           GeometryRules const& rules) {
  auto const& surface = is_detailed_shading(object) ? object["base_surface_name"] : object.name;
  auto const name = input.zone_of.find(input.base_surface(upper(surface)));
  if (name == input.zone_of.end()) return std::nullopt;
  auto const zone = rules.zones.find(name->second);
  return zone == rules.zones.end() ? std::nullopt : std::optional(zone->second);
}

std::optional<GeometryRules> rules_of(std::vector<InputObject> const& objects) {
  try {
    return read_geometry_rules(objects);
  } catch (Error const&) {
    return std::nullopt;
  }
}

std::string describe(std::vector<std::string> const& names, std::size_t degenerate,
                     std::string const& reason) {
  auto text = fmt::format(
      "EnergyPlus deletes coincident vertices (distance < 0.01 m) of {} shading surface{}: {}",
      names.size(), names.size() == 1 ? "" : "s", listed(names, 5));
  if (degenerate > 0) {
    text += fmt::format("; it calls {} of them degenerate and may stop there", degenerate);
  }
  if (!reason.empty()) return text + "; their shadows are simplified too (" + reason + ")";
  return text +
         "; shadows are rendered with all vertices, but daylighting, reflections and outputs of "
         "these surfaces follow EnergyPlus's outlines";
}

}  // namespace

bool is_detailed_shading(InputObject const& object) {
  return object.type.starts_with("Shading:") && attachment_of(object);
}

bool is_detailed_surface(InputObject const& object) { return attachment_of(object).has_value(); }

std::optional<Outline> outline_of(InputObject const& object, ShadingInput const& input,
                                  GeometryRules const& rules) {
  auto const attachment = attachment_of(object);
  auto vertices = vertices_of(object);
  if (!attachment || !vertices) return std::nullopt;
  GeometryRules::Zone zone;
  if (*attachment == Attachment::zone) {
    auto const found = zone_of(object, input, rules);
    if (!found) return std::nullopt;
    zone = *found;
  }
  return to_world(rules, std::move(*vertices), *attachment, zone);
}

std::string reason_against_outlines(std::vector<InputObject> const& objects) {
  for (auto const& object : objects) {
    if (object.type == "GeometryTransform") {
      return object.title() + ": it changes vertices in ways that are not supported here";
    }
    if (object.type == "Compliance:Building" &&
        !object["building_rotation_for_appendix_g"].empty()) {
      return "Compliance:Building: Building Rotation for Appendix G rotates the surfaces";
    }
  }
  return {};
}

SimplifiedSurfaces find_simplified_surfaces(std::vector<InputObject> const& objects,
                                            ShadingInput const& input, Names const& left_out) {
  SimplifiedSurfaces found;
  auto const rules = rules_of(objects);
  if (!rules) return found;
  auto const reason = reason_against_outlines(objects);
  std::vector<std::string> names;
  std::size_t degenerate = 0;
  for (auto const& object : objects) {
    auto const name = upper(object.name);
    if (!is_detailed_shading(object) || left_out.contains(name)) continue;
    auto outline = outline_of(object, input, *rules);
    if (!outline || !(outline->simplified || outline->degenerate)) continue;
    names.push_back(name);
    if (outline->degenerate) ++degenerate;
    if (outline->simplified && reason.empty()) {
      found.outlines.emplace(name, std::move(outline->vertices));
    }
  }
  if (!names.empty()) found.warning = describe(names, degenerate, reason);
  return found;
}

}  // namespace gpu_shading::energyplus
