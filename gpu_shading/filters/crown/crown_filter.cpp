#include "filters/crown/crown_filter.h"

#include <cmath>

namespace gpu_shading {

BeamFilter::Faces faces_of(Crown const& kind) { return {0.0, kind.height, true}; }

FilterLook look_of(Crown const& kind) {
  double const density = 0.5 * (kind.leaf_density + kind.wood_density);
  return {FilterLook::Kind::foliage, std::exp(-density * kind.height)};
}

void add_values(FilterDigest& digest, Crown const& kind) {
  digest.add(static_cast<double>(kind.shape));
  digest.add(kind.height);
  digest.add(kind.leaf_density);
  digest.add(static_cast<double>(kind.leaf_angles));
  digest.add(kind.wood_density);
  digest.add(static_cast<double>(kind.deployment));
  if (!kind.mesh) return;
  digest.add_shared(kind.mesh.get(), [&](FilterDigest& shared) {
    for (CrownMesh::Triangle const& triangle : kind.mesh->triangles()) {
      for (glm::dvec3 const& corner : triangle) {
        for (int axis = 0; axis < 3; ++axis) shared.add(corner[axis]);
      }
    }
  });
}

}  // namespace gpu_shading
