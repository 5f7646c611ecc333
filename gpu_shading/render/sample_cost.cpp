#include "render/sample_cost.h"

#include <cmath>

#include "scene/detail.h"

namespace gpu_shading {

double sample_cost(Detail const& detail, int side, bool transmits, std::size_t interiors) {
  double const rows = side;
  // Edges in a row that is covered already cost less: hence the root.
  double const crossed = std::sqrt(detail.total() * rows);
  double const behind = static_cast<double>(interiors);
  double const passed = transmits ? rows * rows : 0.0;
  return (1.5 + 1.4 * behind) * rows + 21.0 * crossed + 0.09 * passed;
}

}  // namespace gpu_shading
