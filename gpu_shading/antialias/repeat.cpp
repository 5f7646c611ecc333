#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>

#include "antialias/antialias.h"
#include "geometry/ring.h"

namespace gpu_shading {
namespace {

// A surface with more is no blade.
constexpr std::size_t max_vertices = 8;
// The surfaces of a blade that is a box, and of a second one between it and the next.
constexpr SurfaceId max_between = 12;

bool is_moved(Ring const& ring, Ring const& other, glm::dvec3 const& step, double slack) {
  for (std::size_t i = 1; i < ring.size(); ++i) {
    if (glm::distance(ring[i], other[i] + step) > slack) return false;
  }
  return true;
}

}  // namespace

std::optional<Repeat> repeat_of(Scene const& scene, SurfaceId id) {
  Ring const& ring = scene[id].polygon.outline;
  if (ring.size() < 3 || ring.size() > max_vertices) return std::nullopt;
  glm::dvec3 const edge = longest_side(ring);
  double const slack = 1e-6 * glm::length(edge);
  for (SurfaceId back = 1; back <= std::min(id, max_between); ++back) {
    Ring const& other = scene[id - back].polygon.outline;
    if (other.size() != ring.size()) continue;
    glm::dvec3 const step = ring[0] - other[0];
    if (glm::length(step) > slack && is_moved(ring, other, step, slack)) return Repeat{step, edge};
  }
  return std::nullopt;
}

SampledRepeats repeats_among(Scene const& scene, std::span<SurfaceId const> casters) {
  // A few casters suffice: blades that alias are many.
  constexpr std::size_t max_samples = 32;
  constexpr std::size_t min_casters = 8;
  SampledRepeats repeats;
  if (casters.size() < min_casters) return repeats;
  std::size_t const count = std::min(max_samples, casters.size());
  repeats.share = 1.0 / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    auto const repeat = repeat_of(scene, casters[i * casters.size() / count]);
    if (repeat) repeats.found.push_back(*repeat);
  }
  return repeats;
}

}  // namespace gpu_shading
