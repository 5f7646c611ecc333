#include "model/site/own_building.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "gpu_shading/footprint.h"

namespace gpu_shading::energyplus {
namespace {

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
  auto const [west, east] = std::minmax_element(
      outline.begin(), outline.end(), [](auto const& a, auto const& b) { return a.x < b.x; });
  auto const [south, north] = std::minmax_element(
      outline.begin(), outline.end(), [](auto const& a, auto const& b) { return a.y < b.y; });
  return west->x <= point.x && point.x <= east->x && south->y <= point.y && point.y <= north->y;
}

bool holds(ContextBuilding const& building, glm::dvec3 const& point) {
  return building.base <= point.z && point.z <= building.roof.outline.front().z &&
         is_near(building.roof, point) && covers(building.roof, point);
}

}  // namespace

std::vector<std::string> warn_of_own_buildings(std::vector<ContextBuilding> const& buildings,
                                               Scene const& scene, ShadingInput const& input,
                                               std::size_t most) {
  auto const points = inner_points(scene, input);
  std::set<std::string> known;
  std::vector<std::string> lines;
  for (auto const& building : buildings) {
    if (lines.size() == most) break;
    auto const inside = std::find_if(points.begin(), points.end(), [&](InnerPoint const& inner) {
      return holds(building, inner.point);
    });
    if (inside == points.end() || !known.insert(building.name).second) continue;
    lines.push_back(
        fmt::format("{} encloses the model's {}: if it is the modelled building itself, leave it "
                    "out with a Left Out Name",
                    building.name, *inside->surface));
  }
  return lines;
}

}  // namespace gpu_shading::energyplus
