#include "render/sample_cost.h"

#include <algorithm>
#include <cmath>

#include "scene/casters.h"

namespace gpu_shading {

double sample_cost(InView const& in_view, int side, bool transmits, std::size_t interiors) {
  double const rows = side;
  // Edges in a row that is covered already cost less: hence the root.
  double const crossed = std::sqrt(in_view.detail.total() * rows);
  double const behind = static_cast<double>(interiors);
  double const passed = transmits ? rows * rows : 0.0;
  // Below this, the edges in view are so few that an exact answer always costs less.
  constexpr double least = 300.0;
  return std::max(least, (1.5 + 1.4 * behind) * rows + 21.0 * crossed + 0.09 * passed);
}

}  // namespace gpu_shading
