#include "raster_cpu/surface_pieces.h"

#include <cstdint>
#include <glm/geometric.hpp>

namespace gpu_shading {

DepthPlane ProjectedPiece::depth() const {
  DepthPlane plane;
  auto const [nearest, farthest] =
      std::minmax_element(depths_.begin(), depths_.begin() + static_cast<std::ptrdiff_t>(count_));
  plane.nearest = *nearest;
  plane.farthest = *farthest;
  glm::dvec2 const a = corners_[1] - corners_[0];
  glm::dvec2 const b = corners_[2] - corners_[0];
  double const twice_area = cross(a, b);
  double const up_a = depths_[1] - depths_[0];
  double const up_b = depths_[2] - depths_[0];
  if (twice_area != 0.0) {
    plane.slope = glm::dvec2(up_a * b.y - up_b * a.y, up_b * a.x - up_a * b.x) / twice_area;
  }
  plane.start = depths_[0] - glm::dot(plane.slope, corners_[0]);
  return plane;
}

SurfacePieces::SurfacePieces(std::span<Mesh const> meshes) {
  ranges_.reserve(meshes.size());
  for (Mesh const& mesh : meshes) {
    auto const base = static_cast<std::uint32_t>(points_.size());
    std::vector<glm::uvec4> const pieces = convex_pieces(mesh);
    ranges_.push_back({pieces_.size(), pieces.size()});
    for (glm::uvec4 const& piece : pieces) pieces_.push_back(piece + base);
    points_.insert(points_.end(), mesh.vertices.begin(), mesh.vertices.end());
  }
}

}  // namespace gpu_shading
