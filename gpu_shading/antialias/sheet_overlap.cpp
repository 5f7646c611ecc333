#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "antialias/antialias.h"
#include "geometry/convex_polygon.h"

namespace gpu_shading {
namespace {

struct PartOnTile {
  int screen;
  ConvexPolygon polygon;
};

std::vector<PartOnTile> parts_on_tile(Screens const& screens, std::span<int const> numbers,
                                      View const& view) {
  ConvexPolygon tile;
  tile.take(std::to_array<glm::dvec2>({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  std::vector<PartOnTile> parts;
  for (int const number : numbers) {
    for (Screens::Quadrilateral const& part : screens[number].parts) {
      std::array<glm::dvec2, 4> ring;
      std::transform(part.corners.begin(), part.corners.end(), ring.begin(),
                     [&](glm::dvec3 const& corner) {
                       glm::dvec3 const p = corner - view.origin;
                       return glm::dvec2(at(view.x, p), at(view.y, p));
                     });
      // A triangle has its last corner twice.
      auto const corners =
          static_cast<std::size_t>(std::unique(ring.begin(), ring.end()) - ring.begin());
      ConvexPolygon projected;
      PartOnTile on_tile{number, {}};
      if (projected.take(std::span(ring).first(corners)) &&
          intersect(projected, tile, on_tile.polygon) != Meeting::apart) {
        parts.push_back(on_tile);
      }
    }
  }
  return parts;
}

}  // namespace

bool any_overlap(Screens const& screens, std::span<int const> numbers, View const& view) {
  // Of the tile, of area 4: neighbours that touch do not overlap.
  constexpr double min_area = 1e-6;
  std::vector<PartOnTile> const parts = parts_on_tile(screens, numbers, view);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      if (parts[i].screen == parts[k].screen) continue;
      ConvexPolygon common;
      if (intersect(parts[i].polygon, parts[k].polygon, common) != Meeting::apart &&
          2.0 * common.area() > min_area) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace gpu_shading
