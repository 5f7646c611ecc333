#include "model/reflex_corners.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "gpu_shading/error.h"
#include "model/geometry_rules.h"
#include "model/shading_outlines.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

bool is_reflex(Ring const& ring, std::size_t vertex) {
  auto const count = ring.size();
  auto const& corner = ring[vertex];
  auto const turn =
      glm::cross(corner - ring[(vertex + count - 1) % count], ring[(vertex + 1) % count] - corner);
  return glm::dot(turn, normal({ring, {}})) < 0.0;
}

bool has_reflex_corner(Ring const& ring, bool shading) {
  return std::ranges::any_of(straight_limits, [&](double straight) {
    auto const kept = without_deleted(ring, straight);
    return is_reflex(kept, 1) || (shading && is_reflex(kept, kept.size() - 2));
  });
}

}  // namespace

std::vector<std::string> find_reflex_corners(std::vector<InputObject> const& objects,
                                             ShadingInput const& input, Names const& left_out) {
  std::vector<std::string> names;
  std::optional<GeometryRules> rules;
  for (auto const& object : objects) {
    if (!is_detailed_surface(object)) continue;
    auto name = upper(object.name);
    bool const shading = is_detailed_shading(object);
    if (left_out.contains(name) || (!shading && !input.receives(name))) continue;
    auto ring = vertices_of(object);
    constexpr std::size_t fewest = 4;
    if (!ring || ring->size() < fewest) continue;
    if (!rules) {
      try {
        rules = read_geometry_rules(objects);
      } catch (Error const&) {
        return {};  // EnergyPlus reports it
      }
    }
    if (has_reflex_corner(in_energyplus_order(*rules, std::move(*ring)), shading)) {
      names.push_back(std::move(name));
    }
  }
  return names;
}

}  // namespace gpu_shading::energyplus
