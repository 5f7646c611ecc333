#include "input/tile_axes.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace gpu_shading::energyplus {

TileAxes tile_axes(Polygon const& polygon, ScreenPlacement const& placement) {
  glm::dvec3 const facing = normal(polygon);
  glm::dvec3 const& corner = polygon.outline[1];
  glm::dvec3 const edge = polygon.outline[2] - corner;
  // A polygon that is not quite planar is taken at its plane.
  glm::dvec3 const right = glm::normalize(edge - glm::dot(edge, facing) * facing);
  glm::dvec3 const up = glm::cross(facing, right);
  double const c = std::cos(placement.rotation);
  double const s = std::sin(placement.rotation);
  return {corner + placement.origin_u * right + placement.origin_v * up, c * right + s * up,
          c * up - s * right};
}

}  // namespace gpu_shading::energyplus
