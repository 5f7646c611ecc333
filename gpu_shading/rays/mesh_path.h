#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "filters/crown/crowns.h"
#include "rays/ray_tree.h"

namespace gpu_shading {

// The mesh of a crown as single rays meet it.
class MeshPaths {
 public:
  explicit MeshPaths(Crowns::Entry const& crown);

  struct Path {
    double begin = 0.0;      // where the ray first meets the mesh, or its own origin in it
    double length = 0.0;     // inside, of the part of the ray that counts
    glm::dvec3 facing{0.0};  // of the face where it leaves the mesh last
  };
  Path operator()(RayPath const& ray) const;

 private:
  glm::dvec3 centre_;
  double reach_;
  std::vector<CrownMesh::Triangle> faces_;
  RayTree tree_;
};

}  // namespace gpu_shading
