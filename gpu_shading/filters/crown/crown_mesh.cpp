#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <utility>

#include "filters/crown/crowns.h"
#include "gpu_shading/error.h"

namespace gpu_shading {
namespace {

using Triangle = CrownMesh::Triangle;

struct ByCoordinates {
  bool operator()(glm::dvec3 const& a, glm::dvec3 const& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

double six_volumes(Triangle const& face) { return glm::dot(face[0], glm::cross(face[1], face[2])); }

// The triangles on both sides of each edge.
class Neighbours {
 public:
  explicit Neighbours(std::vector<Triangle> const& triangles) : triangles_(triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t side = 0; side < 3; ++side) edges_[edge(i, side).first].push_back(i);
    }
    for (auto const& [ends, sides] : edges_) {
      if (sides.size() == 2) continue;
      glm::dvec3 const& a = ends.first;
      glm::dvec3 const& b = ends.second;
      throw Error(
          fmt::format("the edge from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) of a "
                      "crown's mesh belongs to {} triangle{}, expected 2 in a closed mesh",
                      a.x, a.y, a.z, b.x, b.y, b.z, sides.size(), sides.size() == 1 ? "" : "s"));
    }
  }

  // Beyond a side of a triangle, and whether it runs along the edge in the same direction.
  std::pair<std::size_t, bool> beyond(std::size_t triangle, std::size_t side) const {
    auto const [ends, forwards] = edge(triangle, side);
    auto const& sides = edges_.at(ends);
    std::size_t const other = sides[0] == triangle ? sides[1] : sides[0];
    for (std::size_t i = 0; i < 3; ++i) {
      if (auto const found = edge(other, i); !differ(found.first, ends)) {
        return {other, found.second == forwards};
      }
    }
    return {other, false};
  }

 private:
  using Ends = std::pair<glm::dvec3, glm::dvec3>;
  struct Before {
    bool operator()(Ends const& a, Ends const& b) const {
      ByCoordinates const before;
      if (before(a.first, b.first)) return true;
      return !before(b.first, a.first) && before(a.second, b.second);
    }
  };

  static bool differ(Ends const& a, Ends const& b) {
    return a.first != b.first || a.second != b.second;
  }

  // In order, and whether the triangle runs along them so.
  std::pair<Ends, bool> edge(std::size_t triangle, std::size_t side) const {
    glm::dvec3 const& a = triangles_[triangle].at(side);
    glm::dvec3 const& b = triangles_[triangle].at((side + 1) % 3);
    return ByCoordinates()(a, b) ? std::pair(Ends(a, b), true) : std::pair(Ends(b, a), false);
  }

  std::vector<Triangle> const& triangles_;
  std::map<Ends, std::vector<std::size_t>, Before> edges_;
};

}  // namespace

CrownMesh::CrownMesh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (triangles_.empty()) throw Error("a crown's mesh has no triangles");
  // Written so that NaN fails.
  auto const is_within = [](double coordinate) { return std::abs(coordinate) <= 1.0; };
  for (Triangle const& face : triangles_) {
    for (glm::dvec3 const& p : face) {
      if (is_within(p.x) && is_within(p.y) && is_within(p.z)) continue;
      throw Error(
          fmt::format("vertex ({:.6g}, {:.6g}, {:.6g}) of a crown's mesh is outside the "
                      "cube from -1 to 1",
                      p.x, p.y, p.z));
    }
  }
  Neighbours const neighbours(triangles_);
  std::vector<bool> turned(triangles_.size(), false);
  std::vector<bool> seen(triangles_.size(), false);
  for (std::size_t start = 0; start < triangles_.size(); ++start) {
    if (seen[start]) continue;
    std::vector<std::size_t> part{start};
    seen[start] = true;
    double volume = 0.0;
    for (std::size_t next = 0; next < part.size(); ++next) {
      std::size_t const triangle = part[next];
      volume += (turned[triangle] ? -1.0 : 1.0) * six_volumes(triangles_[triangle]);
      for (std::size_t side = 0; side < 3; ++side) {
        auto const [other, alike] = neighbours.beyond(triangle, side);
        if (seen[other]) continue;
        seen[other] = true;
        turned[other] = turned[triangle] != alike;
        part.push_back(other);
      }
    }
    for (std::size_t const triangle : part) {
      if (volume < 0.0) turned[triangle] = !turned[triangle];
    }
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (turned[i]) std::swap(triangles_[i][1], triangles_[i][2]);
  }
}

double CrownMesh::volume() const {
  double volume = 0.0;
  for (Triangle const& face : triangles_) volume += six_volumes(face) / 6.0;
  return volume;
}

std::optional<FaceCrossing> FaceCrossing::of(Triangle const& corners, double y) {
  glm::dvec2 rising(0.0);  // x and distance
  glm::dvec2 falling(0.0);
  bool met = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    glm::dvec3 const& a = corners[i];
    glm::dvec3 const& b = corners[(i + 1) % corners.size()];
    if ((a.y <= y) == (b.y <= y)) continue;
    met = true;
    bool const rises = a.y <= y;
    glm::dvec3 const& from = rises ? a : b;
    glm::dvec3 const& to = rises ? b : a;
    double const share = (y - from.y) / (to.y - from.y);
    (rises ? rising : falling) = {from.x + share * (to.x - from.x),
                                  from.z + share * (to.z - from.z)};
  }
  if (!met || rising.x == falling.x) return std::nullopt;
  bool const anticlockwise = rising.x > falling.x;
  glm::dvec2 const& low = anticlockwise ? falling : rising;
  glm::dvec2 const& high = anticlockwise ? rising : falling;
  return FaceCrossing{low.x, high.x, low.y, (high.y - low.y) / (high.x - low.x), anticlockwise};
}

}  // namespace gpu_shading
