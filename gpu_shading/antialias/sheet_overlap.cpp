#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "antialias/antialias.h"
#include "geometry/convex_area.h"

namespace gpu_shading {
namespace {

using RingOnTile = std::vector<glm::dvec2>;

double twice_area(RingOnTile const& ring) {
  double twice = 0.0;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    twice += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return twice;
}

// Both convex and counterclockwise.
RingOnTile common(RingOnTile ring, RingOnTile const& by) {
  RingOnTile kept;
  for (std::size_t i = 0; i < by.size() && !ring.empty(); ++i) {
    glm::dvec2 const along = by[(i + 1) % by.size()] - by[i];
    kept.clear();
    for (std::size_t k = 0; k < ring.size(); ++k) {
      glm::dvec2 const& p = ring[k];
      glm::dvec2 const& q = ring[(k + 1) % ring.size()];
      double const at_p = cross(along, p - by[i]);
      double const at_q = cross(along, q - by[i]);
      if (at_p >= 0.0) kept.push_back(p);
      if ((at_p < 0.0) != (at_q < 0.0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    std::swap(ring, kept);
  }
  return ring;
}

struct PartOnTile {
  int screen;
  RingOnTile on_tile;
  glm::dvec2 low;
  glm::dvec2 high;

  PartOnTile(int number, RingOnTile ring) : screen(number), on_tile(std::move(ring)) {
    low = high = on_tile.front();
    for (glm::dvec2 const& corner : on_tile) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }

  bool is_near(PartOnTile const& other) const {
    return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
  }
};

std::vector<PartOnTile> parts_on_tile(Screens const& screens, std::span<int const> numbers,
                                      View const& view) {
  RingOnTile const tile{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<PartOnTile> parts;
  for (int const number : numbers) {
    for (Screens::Quadrilateral const& part : screens[number].parts) {
      RingOnTile ring;
      for (glm::dvec3 const& corner : part.corners) {
        glm::dvec3 const p = corner - view.origin;
        ring.emplace_back(at(view.x, p), at(view.y, p));
      }
      if (twice_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
      ring = common(std::move(ring), tile);
      if (ring.size() > 2) parts.emplace_back(number, std::move(ring));
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
      if (parts[i].screen == parts[k].screen || !parts[i].is_near(parts[k])) continue;
      if (twice_area(common(parts[i].on_tile, parts[k].on_tile)) > min_area) return true;
    }
  }
  return false;
}

}  // namespace gpu_shading
