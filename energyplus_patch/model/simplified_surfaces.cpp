#include "model/simplified_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "model/geometry_rules.h"
#include "model/shading_outlines.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

std::optional<GeometryRules> rules_of(std::vector<InputObject> const& objects) {
  try {
    return read_geometry_rules(objects);
  } catch (Error const&) {
    return std::nullopt;
  }
}

// "A, B, C and 4 more"
std::string list(std::vector<std::string> const& names) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

std::string describe(std::vector<std::string> const& names, std::size_t degenerate,
                     std::string const& reason) {
  auto text = fmt::format(
      "EnergyPlus deletes coincident vertices (distance < 0.01 m) of {} shading surface{}: {}",
      names.size(), names.size() == 1 ? "" : "s", list(names));
  if (degenerate > 0) {
    text += fmt::format("; it calls {} of them degenerate and may stop there", degenerate);
  }
  if (!reason.empty()) return text + "; their shadows are simplified too (" + reason + ")";
  return text +
         "; shadows are rendered with all vertices, but daylighting, reflections and outputs of "
         "these surfaces follow EnergyPlus's outlines";
}

}  // namespace

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
