#include "rays/mesh_path.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "rays/ray_shapes.h"

namespace gpu_shading {

MeshPaths::MeshPaths(Crowns::Entry const& crown)
    : centre_(crown.centre), reach_(crown.reach()), faces_(crown.faces()) {
  std::vector<Box> boxes;
  boxes.reserve(faces_.size());
  for (CrownMesh::Triangle const& face : faces_) {
    Box box;
    for (glm::dvec3 const& corner : face) box.include(corner);
    boxes.push_back(with_margin(box));
  }
  tree_ = RayTree(boxes);
}

MeshPaths::Path MeshPaths::operator()(RayPath const& ray) const {
  // All of the mesh counts, also before the ray's origin and beyond its end: faces there cancel
  // out.
  double const middle = glm::dot(centre_ - ray.origin, ray.direction);
  RayPath line = ray;
  line.move_to(ray.origin + (middle - 2.0 * reach_) * ray.direction);
  double const whole = 4.0 * reach_;
  glm::dvec3 const& d = ray.direction;
  glm::dvec3 const other =
      std::abs(d.z) < 0.7 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  glm::dvec3 const right = glm::normalize(glm::cross(other, d));
  glm::dvec3 const up = glm::cross(d, right);
  Path path{ray.length, 0.0, d};
  double last = -HUGE_VAL;
  tree_.search(line, whole, [&](std::uint32_t place) {
    CrownMesh::Triangle const& face = faces_[tree_.order()[place]];
    CrownMesh::Triangle corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      glm::dvec3 const p = face[i] - ray.origin;
      corners[i] = {glm::dot(right, p), glm::dot(up, p), glm::dot(d, p)};
    }
    auto const crossing = FaceCrossing::of(corners, 0.0);
    if (!crossing || crossing->low > 0.0 || crossing->high <= 0.0) return;
    double const distance = crossing->distance_at(0.0);
    double const counted = std::clamp(distance, 0.0, ray.length);
    path.length += crossing->anticlockwise ? counted : -counted;
    path.begin = std::min(path.begin, counted);
    if (crossing->anticlockwise && distance > last) {
      last = distance;
      path.facing = glm::normalize(glm::cross(face[1] - face[0], face[2] - face[0]));
    }
  });
  path.length = std::max(0.0, path.length);
  return path;
}

}  // namespace gpu_shading
