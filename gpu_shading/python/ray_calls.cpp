#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "gpu_shading/rays.h"
#include "python/guard.h"

namespace gpu_shading::python {

struct RaysObject {
  RayScene rays;
};

namespace {

// Lists of the surfaces that rays meet take more memory than the rays.
constexpr std::size_t block = 16384;

RayConditions conditions_of(RayRecord const& record) {
  RayConditions conditions;
  if (record.receiver >= 0) conditions.receiver = static_cast<SurfaceId>(record.receiver);
  conditions.excluded = {record.excluded, record.excluded_count};
  conditions.factors = {record.factors, record.factor_count};
  conditions.deployments = {record.deployments, record.deployment_count};
  return conditions;
}

glm::dvec3 row_of(double const* rows, std::size_t index) {
  return {rows[3 * index], rows[3 * index + 1], rows[3 * index + 2]};
}

std::vector<Ray> rays_of(RayRecord const& record, std::size_t first, std::size_t end) {
  std::vector<Ray> rays(end - first);
  for (std::size_t i = first; i < end; ++i) {
    auto& ray = rays[i - first];
    ray.origin = row_of(record.origins, i);
    ray.direction = row_of(record.directions, i);
    if (record.lengths != nullptr) ray.length = record.lengths[i];
  }
  return rays;
}

// Calls `answer` with the rays of each block and the index of its first.
template <typename Answer>
void for_each_block(RayRecord const& record, Answer const& answer) {
  for (std::size_t first = 0; first < record.rays && !is_closed(); first += block) {
    answer(rays_of(record, first, std::min(record.rays, first + block)), first);
  }
}

// The nearest surface of those that a ray meets.
RayLayer const* nearest(std::vector<RayLayer> const& layers, bool opaque) {
  if (layers.empty()) return nullptr;
  if (!opaque) return &layers.front();
  return layers.back().transmittance == 0.0 ? &layers.back() : nullptr;
}

}  // namespace

// Faces: of RayFaces; screens: of ScreenDetail.
GPU_SHADING_CALL int gpu_shading_rays_new(SceneObject const* scene, int faces, int screens,
                                          RaysObject** made) {
  return guarded([&] {
    RayOptions options;
    options.faces = enumerator(faces, RayFaces::both, "faces");
    options.screens = enumerator(screens, ScreenDetail::effective, "screens");
    *made = new RaysObject{RayScene(scene->scene, options)};
  });
}

GPU_SHADING_CALL int gpu_shading_rays_transmittance(RaysObject const* object, RayRecord const* rays,
                                                    double* results) {
  return guarded([&] {
    auto const conditions = conditions_of(*rays);
    for_each_block(*rays, [&](std::vector<Ray> const& some, std::size_t first) {
      object->rays.transmittances(some, conditions, std::span(results + first, some.size()));
    });
  });
}

// Surface -1 and an infinite distance where nothing is met. `opaque`: only surfaces that let
// nothing of the ray pass.
GPU_SHADING_CALL int gpu_shading_rays_nearest(RaysObject const* object, RayRecord const* rays,
                                              int opaque, std::int64_t* surfaces,
                                              double* distances) {
  return guarded([&] {
    auto const conditions = conditions_of(*rays);
    for_each_block(*rays, [&](std::vector<Ray> const& some, std::size_t first) {
      std::vector<std::vector<RayLayer>> layers(some.size());
      object->rays.layers(some, conditions, layers);
      for (std::size_t i = 0; i < some.size(); ++i) {
        auto const* const met = nearest(layers[i], opaque != 0);
        surfaces[first + i] = met == nullptr ? -1 : static_cast<std::int64_t>(met->surface);
        distances[first + i] =
            met == nullptr ? std::numeric_limits<double>::infinity() : met->distance;
      }
    });
  });
}

GPU_SHADING_CALL void gpu_shading_rays_release(RaysObject* object) { release(object); }

}  // namespace gpu_shading::python
