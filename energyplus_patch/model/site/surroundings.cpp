#include "model/site/surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <set>
#include <string_view>

#include "gpu_shading/footprint.h"
#include "model/extensions/extension_fields.h"

namespace gpu_shading::energyplus {
namespace {

bool any_of_type(std::vector<InputObject> const& objects, std::string_view type) {
  return std::ranges::any_of(objects,
                             [&](InputObject const& object) { return object.type == type; });
}

struct InnerPoint {
  std::string const* surface;
  glm::dvec3 point;
};

// A point behind each base surface, so that a neighbour wall to wall does not contain it.
std::vector<InnerPoint> inner_points(Scene const& scene, ShadingInput const& input) {
  constexpr double behind = 0.1;  // m
  std::vector<InnerPoint> points;
  for (SurfaceId id = 0; id < scene.size(); ++id) {
    auto const& polygon = scene[id].polygon;
    if (!input.zone_of.contains(scene[id].name) || area(polygon) <= 0.0) continue;
    auto const& outline = polygon.outline;
    auto const middle = std::accumulate(outline.begin(), outline.end(), glm::dvec3(0.0)) /
                        static_cast<double>(outline.size());
    points.push_back({&scene[id].name, middle - behind * normal(polygon)});
  }
  return points;
}

bool is_near(Polygon const& roof, glm::dvec3 const& point) {
  auto const& outline = roof.outline;
  auto const [west, east] = std::ranges::minmax_element(outline, {}, &glm::dvec3::x);
  auto const [south, north] = std::ranges::minmax_element(outline, {}, &glm::dvec3::y);
  return west->x <= point.x && point.x <= east->x && south->y <= point.y && point.y <= north->y;
}

bool holds(ContextBuilding const& building, glm::dvec3 const& point) {
  return building.base <= point.z && point.z <= building.roof.outline.front().z &&
         is_near(building.roof, point) && covers(building.roof, point);
}

// Whether a polygon lies above a point.
bool lies_over(Polygon const& polygon, glm::dvec3 const& point) {
  auto const up = normal(polygon);
  constexpr double steepest = 0.1;
  if (std::abs(up.z) < steepest || !is_near(polygon, point) || !covers(polygon, point))
    return false;
  return glm::dot(polygon.outline.front() - point, up) / up.z > 0.0;
}

}  // namespace

std::optional<TextureAxes> Surroundings::texture_of(SurfaceId surface) const {
  if (surface < first || surface - first >= casters.size()) return std::nullopt;
  return casters[surface - first].texture;
}

Surroundings read_surroundings(std::vector<InputObject> const& objects, AssetFolder const& folder,
                               bool horizons) {
  Surroundings surroundings;
  std::optional<SiteOrigin> origin;
  std::vector<TerrainGrid> terrains;
  if (any_of_type(objects, extension::site_context::type) || needs_origin(objects) ||
      needs_origin_for_trees(objects)) {
    origin = find_site_origin(objects);
    terrains = read_site_contexts(objects, folder.path, horizons, *origin, surroundings);
  }
  read_geometries(objects, folder, origin, surroundings);
  read_trees(objects, folder.path, origin, terrains, surroundings);
  return surroundings;
}

void Extent::include(Ring const& ring) {
  for (auto const& point : ring) {
    low_ = empty_ ? point : glm::min(low_, point);
    high_ = empty_ ? point : glm::max(high_, point);
    empty_ = false;
  }
}

double Extent::distance() const {
  auto const nearest = glm::clamp(glm::dvec3(0.0), low_, high_);
  return std::hypot(nearest.x, nearest.y);
}

std::string Extent::describe() const {
  if (empty_) return "no part of it is left";
  // No -0.
  auto const rounded = [](double value) { return std::round(10.0 * value) / 10.0 + 0.0; };
  return fmt::format("x {:.1f} to {:.1f}, y {:.1f} to {:.1f}, z {:.1f} to {:.1f} m",
                     rounded(low_.x), rounded(high_.x), rounded(low_.y), rounded(high_.y),
                     rounded(low_.z), rounded(high_.z));
}

std::vector<std::string> warn_of_own_buildings(std::vector<ContextBuilding> const& buildings,
                                               Scene const& scene, ShadingInput const& input,
                                               std::size_t max) {
  auto const points = inner_points(scene, input);
  std::set<std::string> known;
  std::vector<std::string> lines;
  for (auto const& building : buildings) {
    if (lines.size() == max) break;
    auto const inside = std::ranges::find_if(
        points, [&](InnerPoint const& inner) { return holds(building, inner.point); });
    if (inside == points.end() || !known.insert(building.name).second) continue;
    lines.push_back(
        fmt::format("{} encloses the model's {}: if it is the modelled building itself, leave it "
                    "out with a Left Out Name",
                    building.name, *inside->surface));
  }
  return lines;
}

std::vector<std::string> warn_of_covers(Scene const& scene, ShadingInput const& input,
                                        Names const& transmitting, std::size_t max) {
  auto const points = inner_points(scene, input);
  std::vector<std::string> lines;
  if (points.empty()) return lines;
  for (SurfaceId id = 0; id < scene.size() && lines.size() < max; ++id) {
    auto const& surface = scene[id];
    auto const found = input.shading_surfaces.find(surface.name);
    if (found == input.shading_surfaces.end() || transmitting.contains(surface.name)) continue;
    auto const& type = found->second.type;
    bool const may_be_building =
        found->second.transmittance_schedule.empty() &&
        (type.starts_with("Shading:Site") || type.starts_with("Shading:Building"));
    if (!may_be_building || !std::ranges::all_of(points, [&](InnerPoint const& inner) {
          return lies_over(surface.polygon, inner.point);
        })) {
      continue;
    }
    lines.push_back(fmt::format(
        "{} {} lies over the whole model: if it is the modelled building itself, remove it", type,
        surface.name));
  }
  return lines;
}

}  // namespace gpu_shading::energyplus
