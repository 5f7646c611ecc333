#include "runs/drawn_surfaces.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

// The plane of a wall, which contains its openings.
struct Plane {
  glm::dvec3 point;
  glm::dvec3 normal;

  explicit Plane(Ring const& wall) : point(0.0), normal(gpu_shading::normal({wall, {}})) {
    for (auto const& vertex : wall) point += vertex / static_cast<double>(wall.size());
  }

  glm::dvec3 nearest(glm::dvec3 const& p) const { return p - glm::dot(p - point, normal) * normal; }
};

Ring onto(Plane const& plane, Ring const& ring) {
  Ring flat;
  flat.reserve(ring.size());
  for (auto const& vertex : ring) flat.push_back(plane.nearest(vertex));
  return flat;
}

// The reveals between a set-back window and the opening in its wall's plane, as seen from within
// the opening.
std::vector<Surface> reveals_of(DrawnSurface const& window, Ring const& opening) {
  constexpr double least = 1e-3;
  std::vector<Surface> reveals;
  if (glm::distance(window.outline.front(), opening.front()) < least) return reveals;
  for (std::size_t i = 0; i < opening.size(); ++i) {
    auto const next = (i + 1) % opening.size();
    Surface reveal;
    reveal.name = fmt::format("{} reveal {}", window.name, i + 1);
    reveal.polygon.outline = {opening[i], window.outline[i], window.outline[next], opening[next]};
    reveals.push_back(std::move(reveal));
  }
  return reveals;
}

}  // namespace

std::vector<Surface> surfaces_of(std::vector<DrawnSurface> const& drawing,
                                 ShadingInput const& input) {
  std::vector<Surface> surfaces;
  std::unordered_map<std::string, std::size_t> place_of;
  for (auto const& drawn : drawing) {
    place_of[upper(drawn.name)] = surfaces.size();
    Surface surface;
    surface.name = drawn.name;
    surface.polygon.outline = drawn.outline;
    surfaces.push_back(std::move(surface));
  }
  for (auto const& drawn : drawing) {
    auto const base = input.base_of.find(upper(drawn.name));
    if (base == input.base_of.end() || drawn.outline.empty()) continue;
    auto const wall = place_of.find(base->second);
    if (wall == place_of.end()) continue;
    auto& polygon = surfaces[wall->second].polygon;
    auto opening = onto(Plane(polygon.outline), drawn.outline);
    auto reveals = reveals_of(drawn, opening);
    polygon.holes.push_back(std::move(opening));
    for (auto& reveal : reveals) surfaces.push_back(std::move(reveal));
  }
  return surfaces;
}

bool is_exterior(std::string const& surface, ShadingInput const& input) {
  auto const wall = input.base_surface(upper(surface));
  return input.zone_of.contains(wall) && !input.not_exterior.contains(wall);
}

}  // namespace gpu_shading::energyplus
