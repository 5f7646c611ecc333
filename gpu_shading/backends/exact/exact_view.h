#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "backends/interface/view_backend.h"
#include "filters/transmission.h"
#include "geometry/plane_frame.h"
#include "gpu_shading/scene.h"
#include "scene/relative_polygon.h"

namespace gpu_shading {

// A receiver at one direction of the sun, and what may shade it.
struct ExactQuestion {
  RelativePolygon const& receiver;
  PlaneFrame const& frame;
  glm::dvec3 towards_sun{0.0};                      // in front of the receiver
  std::span<RelativePolygon const* const> casters;  // flat, and no perforated screens
  bool through = false;  // the receiver is a window, and the sun may reach these behind it:
  std::span<RelativePolygon const> interiors;
};

struct ExactAnswer {
  std::span<LuminanceSums const> sums;
  std::size_t casters = 0;  // whose shadows may meet the receiver
};

// The luminance of a receiver, or of each interior surface, without samples: outlines are projected
// onto its plane along the sun's rays; then a few convex ones are intersected (convex_sums), and
// others swept (swept_sums). In parts of the receiver's own area, so that 1 is all of it. Exact to
// about 1e-12.
//
// Empty if a sweep would take more than `most_steps`, or if neither can answer. Valid until the
// thread's next question.
std::optional<ExactAnswer> exact_sums(Scene const& scene, Transmission const& transmission,
                                      ExactQuestion const& question, double most_steps);

}  // namespace gpu_shading
