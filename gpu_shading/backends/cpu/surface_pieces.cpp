#include "backends/cpu/surface_pieces.h"

#include <cstdint>
#include <glm/geometric.hpp>

namespace gpu_shading {

ConvexArea ProjectedPiece::area(int side) const {
  std::array<glm::dvec2, 4> places;
  std::array<double, 4> distances;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    places[i] = place(i);
    distances[i] = at(pixels_.cut, corners_[i] - pixels_.origin);
  }
  return area_in_front({places.data(), corners_.size()}, {distances.data(), corners_.size()}, side);
}

DepthPlane ProjectedPiece::depth() const {
  std::array<double, 4> depths;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    depths[i] = at(pixels_.z, corners_[i] - pixels_.origin);
  }
  DepthPlane plane;
  auto const [nearest, farthest] = std::minmax_element(
      depths.begin(), depths.begin() + static_cast<std::ptrdiff_t>(corners_.size()));
  plane.nearest = *nearest;
  plane.farthest = *farthest;
  glm::dvec2 const origin = place(0);
  glm::dvec2 const a = place(1) - origin;
  glm::dvec2 const b = place(2) - origin;
  double const twice_area = cross(a, b);
  double const up_a = depths[1] - depths[0];
  double const up_b = depths[2] - depths[0];
  if (twice_area != 0.0) {
    plane.slope = glm::dvec2(up_a * b.y - up_b * a.y, up_b * a.x - up_a * b.x) / twice_area;
  }
  plane.start = depths[0] - glm::dot(plane.slope, origin);
  return plane;
}

SurfacePieces::SurfacePieces(std::span<Mesh const> meshes) {
  ranges_.reserve(meshes.size());
  for (Mesh const& mesh : meshes) {
    std::vector<glm::uvec4> const pieces = convex_pieces(mesh);
    ranges_.push_back({pieces_.size(), pieces.size()});
    for (glm::uvec4 const& piece : pieces) {
      Piece& added = pieces_.emplace_back();
      for (std::size_t i = 0; i < added.corners.size(); ++i) {
        added.corners[i] = mesh.vertices[piece[static_cast<int>(i)]];
      }
      added.count = piece[2] == piece[3] ? 3 : 4;
    }
  }
}

}  // namespace gpu_shading
