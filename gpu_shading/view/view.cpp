#include "view/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "scene/casters.h"

namespace gpu_shading {
namespace {

glm::dmat2 golden_turn() {
  double const angle = std::atan(1.0 / std::numbers::phi);
  double const c = std::cos(angle);
  double const s = std::sin(angle);
  return {c, s, -s, c};
}

glm::dvec2 in_plane(PlaneFrame const& frame, glm::dvec3 const& point) {
  glm::dvec3 const p = point - frame.origin;
  return {glm::dot(frame.u, p), glm::dot(frame.v, p)};
}

View slide(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun) {
  // p - s (n.p)/(n.s) is the point where the ray through p meets the plane.
  double const cosine = glm::dot(frame.normal, towards_sun);
  glm::dvec3 const u = frame.u - frame.normal * (glm::dot(frame.u, towards_sun) / cosine);
  glm::dvec3 const v = frame.v - frame.normal * (glm::dot(frame.v, towards_sun) / cosine);
  View view;
  view.origin = frame.origin;
  view.x = glm::dvec4(map.matrix[0][0] * u + map.matrix[1][0] * v, map.offset.x);
  view.y = glm::dvec4(map.matrix[0][1] * u + map.matrix[1][1] * v, map.offset.y);
  return view;
}

}  // namespace

glm::dvec2 TileMap::operator()(PlaneFrame const& frame, glm::dvec3 const& point) const {
  return matrix * in_plane(frame, point) + offset;
}

double TileMap::pixel_area(int resolution) const {
  double const side = 2.0 / resolution;
  return side * side / std::abs(glm::determinant(matrix));
}

TileMap fit_tile(PlaneFrame const& frame, Ring const& outline, int resolution) {
  glm::dmat2 const to_square(1.0 / frame.width, 0.0, 0.0, 1.0 / frame.height);
  glm::dmat2 const turned = golden_turn() * to_square;
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high(-low);
  for (glm::dvec3 const& vertex : outline) {
    glm::dvec2 const place = turned * in_plane(frame, vertex);
    low = glm::dvec2(std::min(low.x, place.x), std::min(low.y, place.y));
    high = glm::dvec2(std::max(high.x, place.x), std::max(high.y, place.y));
  }
  double const margin = std::min(1.0, resolution / 8.0);
  double const filled = 2.0 * (1.0 - 2.0 * margin / resolution);
  glm::dvec2 const scale(filled / (high.x - low.x), filled / (high.y - low.y));
  TileMap map;
  map.matrix = glm::dmat2(scale.x, 0.0, 0.0, scale.y) * turned;
  map.offset = -0.5 * scale * (low + high);
  return map;
}

View view_in_front(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun) {
  View view = slide(frame, map, towards_sun);
  view.cut = glm::dvec4(frame.normal, -clearance);
  return view;
}

View view_behind(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun,
                 double reach) {
  View view = slide(frame, map, towards_sun);
  view.z = glm::dvec4(-frame.normal / reach, 0.0);
  view.cut = glm::dvec4(-frame.normal, -clearance);
  return view;
}

}  // namespace gpu_shading
