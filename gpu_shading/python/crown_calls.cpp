#include "python/guard.h"

namespace gpu_shading::python {

// By the numbers of CrownShape and LeafAngles. A surface's deployment is then its share of leaves.
GPU_SHADING_CALL int gpu_shading_filter_crown(int shape, double height, double leaf_density,
                                              int leaf_angles, double wood_density,
                                              FilterObject** made) {
  return guarded([&] {
    *made = new FilterObject{
        Crown{enumerator(shape, CrownShape::half_ellipsoid, "shape"), height, leaf_density,
              enumerator(leaf_angles, LeafAngles::erectophile, "leaf angles"), wood_density}};
  });
}

}  // namespace gpu_shading::python
