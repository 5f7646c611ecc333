#include "routes/opengl/queries/named_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

// Decimals of the list, single precision at some kilometres, and points of openings that are
// projected onto their wall.
constexpr double tolerance = 2e-3;

// Farther away, single precision is coarser.
bool are_near(glm::dvec3 const& a, glm::dvec3 const& b) {
  constexpr double rounding = 2e-7;
  return glm::distance(a, b) < tolerance + rounding * glm::length(b);
}

// The vertex nearest to a point; there is one.
glm::dvec3 nearest_vertex(std::vector<Polygon> const& parts, glm::dvec3 const& point) {
  glm::dvec3 nearest(HUGE_VAL);
  auto const look = [&](Ring const& ring) {
    for (auto const& vertex : ring) {
      if (glm::distance(vertex, point) < glm::distance(nearest, point)) nearest = vertex;
    }
  };
  for (auto const& part : parts) {
    look(part.outline);
    for (auto const& hole : part.holes) look(hole);
  }
  return nearest;
}

// A ring with the vertices that were drawn, which have more digits.
Ring drawn_ring(std::vector<Polygon> const& parts, Ring ring) {
  for (auto& vertex : ring) {
    auto const nearest = nearest_vertex(parts, vertex);
    if (are_near(nearest, vertex)) vertex = nearest;
  }
  return ring;
}

bool has_all(std::vector<Polygon> const& parts, Ring const& ring) {
  return std::ranges::all_of(ring, [&](glm::dvec3 const& vertex) {
    return are_near(nearest_vertex(parts, vertex), vertex);
  });
}

bool has_all(std::vector<Polygon> const& parts, std::vector<Polygon> const& others) {
  return std::ranges::all_of(others, [&](Polygon const& other) {
    return has_all(parts, other.outline) &&
           std::ranges::all_of(other.holes, [&](Ring const& hole) { return has_all(parts, hole); });
  });
}

struct Box {
  glm::dvec3 low{HUGE_VAL};
  glm::dvec3 high{-HUGE_VAL};

  void add(Ring const& ring) {
    for (auto const& vertex : ring) {
      low = glm::min(low, vertex);
      high = glm::max(high, vertex);
    }
  }
};

// Openings that touch the outline give what is drawn further vertices, or take corners away. The
// list does not say which openings are in walls that EnergyPlus itself has made.
bool are_same(std::vector<Polygon> const& drawn, Polygon const& named) {
  constexpr double min_cosine = 0.9;
  if (drawn.empty() || glm::dot(normal(drawn.front()), normal(named)) < min_cosine) return false;
  Box of_drawn;
  double drawn_area = 0.0;
  for (auto const& part : drawn) {
    of_drawn.add(part.outline);
    drawn_area += area(part);
  }
  constexpr double sides = 4.0;
  double const size = glm::distance(of_drawn.low, of_drawn.high);
  bool const same_area = std::abs(drawn_area - area(named)) < tolerance * size * sides;
  if (!has_all(drawn, named.outline)) return same_area && has_all({named}, drawn);
  Box of_named;
  of_named.add(named.outline);
  return same_area ||
         (are_near(of_drawn.low, of_named.low) && are_near(of_drawn.high, of_named.high));
}

// Named surfaces by their vertices, in cells with room for the tolerance.
class Index {
 public:
  explicit Index(std::vector<Surface> const& named) : named_(named), taken_(named.size(), false) {
    for (std::size_t i = 0; i < named.size(); ++i) {
      for (auto const& vertex : named[i].polygon.outline) places_[cell_of(vertex)].push_back(i);
    }
  }

  // The first that is not taken; as many as named.size() if there is none.
  std::size_t take(std::vector<Polygon> const& drawn) {
    std::size_t found = named_.size();
    for (auto const& part : drawn) {
      for (auto const& vertex : part.outline) look(vertex, drawn, found);
      for (auto const& hole : part.holes) {
        for (auto const& vertex : hole) look(vertex, drawn, found);
      }
    }
    // Distant ones, whose vertices may be in other cells, are few.
    for (std::size_t i = 0; i < named_.size() && found == named_.size(); ++i) {
      if (!taken_[i] && are_same(drawn, named_[i].polygon)) found = i;
    }
    if (found < named_.size()) taken_[found] = true;
    return found;
  }

 private:
  using Cell = std::array<long long, 3>;

  static Cell cell_of(glm::dvec3 const& p) {
    constexpr double side = 0.05;
    return {std::llround(p.x / side), std::llround(p.y / side), std::llround(p.z / side)};
  }

  void look(glm::dvec3 const& vertex, std::vector<Polygon> const& drawn, std::size_t& found) const {
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec3 const offset((corner & 1) != 0 ? tolerance : -tolerance,
                              (corner & 2) != 0 ? tolerance : -tolerance,
                              (corner & 4) != 0 ? tolerance : -tolerance);
      auto const place = places_.find(cell_of(vertex + offset));
      if (place == places_.end()) continue;
      for (auto const i : place->second) {
        if (i < found && !taken_[i] && are_same(drawn, named_[i].polygon)) found = i;
      }
    }
  }

  std::vector<Surface> const& named_;
  std::vector<bool> taken_;
  std::map<Cell, std::vector<std::size_t>> places_;
};

}  // namespace

std::vector<Surface> name_surfaces(std::span<glm::vec3 const> vertices,
                                   std::span<DrawnRange const> surfaces,
                                   std::vector<Surface> const& named) {
  Index index(named);
  std::vector<Surface> found;
  found.reserve(surfaces.size());
  for (auto const& range : surfaces) {
    auto const parts = polygons_of(vertices.subspan(range.first, range.count));
    auto const i = index.take(parts);
    if (i == named.size()) {
      auto const& at = vertices[range.first];
      throw Error(fmt::format(
          "EnergyPlus draws a surface at ({:.3f}, {:.3f}, {:.3f}) that is none of those "
          "in its list of surfaces",
          at.x, at.y, at.z));
    }
    auto& surface = found.emplace_back(named[i]);
    if (parts.size() == 1 && parts.front().holes.size() > surface.polygon.holes.size()) {
      surface.polygon = parts.front();
      continue;
    }
    surface.polygon.outline = drawn_ring(parts, std::move(surface.polygon.outline));
    for (auto& hole : surface.polygon.holes) hole = drawn_ring(parts, std::move(hole));
  }
  return found;
}

}  // namespace gpu_shading::energyplus
