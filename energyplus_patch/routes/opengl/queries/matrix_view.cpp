#include "routes/opengl/queries/matrix_view.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {
namespace {

glm::dvec3 row(std::array<float, 16> const& matrix, std::size_t index) {
  constexpr std::size_t column = 4;
  return {matrix.at(index), matrix.at(column + index), matrix.at(2 * column + index)};
}

}  // namespace

std::optional<MatrixView> MatrixView::of(std::array<float, 16> const& matrix) {
  constexpr double extent = 2.0;  // of what is seen, in OpenGL's coordinates
  auto const across = glm::length(row(matrix, 0));
  auto const up = glm::length(row(matrix, 1));
  // The depth grows away from the sun.
  auto const away = row(matrix, 2);
  auto const depth = glm::length(away);
  bool const usable = std::isfinite(across) && std::isfinite(up) && std::isfinite(depth) &&
                      across > 0.0 && up > 0.0 && depth > 0.0;
  if (!usable || glm::length(row(matrix, 3)) > 0.0) return std::nullopt;
  return MatrixView{-away / depth, extent / across, extent / up};
}

}  // namespace gpu_shading::energyplus
