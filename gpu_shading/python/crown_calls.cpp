#include "python/guard.h"

namespace gpu_shading::python {

// By the numbers of CrownShape and LeafAngles. `corners`: of the triangles of a mesh; nullptr
// without. A surface's deployment is then its share of leaves.
GPU_SHADING_CALL int gpu_shading_filter_crown(int shape, double height, double leaf_density,
                                              int leaf_angles, double wood_density,
                                              double const* corners, std::size_t triangles,
                                              FilterObject** made) {
  return guarded([&] {
    std::shared_ptr<CrownMesh const> mesh;
    if (corners != nullptr) {
      std::vector<CrownMesh::Triangle> faces(triangles);
      for (CrownMesh::Triangle& face : faces) {
        for (glm::dvec3& corner : face) {
          corner = {corners[0], corners[1], corners[2]};
          corners += 3;
        }
      }
      mesh = std::make_shared<CrownMesh const>(std::move(faces));
    }
    *made =
        new FilterObject{Crown{enumerator(shape, CrownShape::mesh, "shape"), height, leaf_density,
                               enumerator(leaf_angles, LeafAngles::erectophile, "leaf angles"),
                               wood_density, -1, std::move(mesh)}};
  });
}

}  // namespace gpu_shading::python
