#include "backends/exact/exact_view.h"

#include "backends/exact/convex_view.h"
#include "backends/exact/projection.h"
#include "backends/exact/swept_view.h"

namespace gpu_shading {

std::optional<ExactAnswer> exact_sums(Scene const& scene, Transmission const& transmission,
                                      ExactQuestion const& question, double most_steps) {
  if (static_cast<double>(question.casters.size()) > most_steps) return std::nullopt;
  Projection const projection(question.frame, question.towards_sun);
  if (auto found = convex_sums(scene, transmission, question, projection)) return found;
  return swept_sums(scene, transmission, question, projection, most_steps);
}

}  // namespace gpu_shading
