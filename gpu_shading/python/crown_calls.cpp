#include "python/guard.h"
#include "python/objects.h"

namespace gpu_shading::python {

int gpu_shading_filter_crown(int shape, double height, double leaf_density, int leaf_angles,
                             double wood_density, FilterObject** made) {
  return guarded([&] {
    *made = new FilterObject{
        Crown{enumerator(shape, CrownShape::half_ellipsoid, "shape"), height, leaf_density,
              enumerator(leaf_angles, LeafAngles::erectophile, "leaf angles"), wood_density}};
  });
}

}  // namespace gpu_shading::python
