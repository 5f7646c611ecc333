#include "view/view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "scene/casters.h"

namespace gpu_shading {
namespace {

glm::dmat2 turn_by(double slope) {
  double const c = 1.0 / std::sqrt(1.0 + slope * slope);
  double const s = slope * c;
  return {c, s, -s, c};
}

glm::dvec2 in_plane(PlaneFrame const& frame, glm::dvec3 const& point) {
  glm::dvec3 const p = point - frame.origin;
  return {glm::dot(frame.u, p), glm::dot(frame.v, p)};
}

struct OutlineBounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  glm::dvec2 size() const { return high - low; }
  glm::dvec2 middle() const { return 0.5 * (low + high); }
};

OutlineBounds outline_bounds(PlaneFrame const& frame, Ring const& outline, glm::dmat2 const& map) {
  OutlineBounds bounds;
  for (glm::dvec3 const& vertex : outline) {
    glm::dvec2 const place = map * in_plane(frame, vertex);
    bounds.low = glm::min(bounds.low, place);
    bounds.high = glm::max(bounds.high, place);
  }
  return bounds;
}

View view_along(glm::dvec3 const& u, glm::dvec3 const& v, PlaneFrame const& frame,
                TileMap const& map) {
  View view;
  view.origin = frame.origin;
  view.x = glm::dvec4(map.matrix[0][0] * u + map.matrix[1][0] * v, map.offset.x);
  view.y = glm::dvec4(map.matrix[0][1] * u + map.matrix[1][1] * v, map.offset.y);
  return view;
}

View slide(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun) {
  // p - s (n.p)/(n.s) is the point where the ray through p meets the plane.
  double const cosine = glm::dot(frame.normal, towards_sun);
  return view_along(frame.u - frame.normal * (glm::dot(frame.u, towards_sun) / cosine),
                    frame.v - frame.normal * (glm::dot(frame.v, towards_sun) / cosine), frame, map);
}

}  // namespace

glm::dvec2 TileMap::operator()(PlaneFrame const& frame, glm::dvec3 const& point) const {
  return matrix * in_plane(frame, point) + offset;
}

double TileMap::pixel_area(int resolution) const {
  double const side = 2.0 / resolution;
  return side * side / std::abs(glm::determinant(matrix));
}

TileMap fit_tile(PlaneFrame const& frame, Ring const& outline, int resolution, TileLay const& lay) {
  double const margin = lay.for_grids ? 0.0 : std::min(1.0, resolution / 8.0);
  double const filled = 2.0 * (1.0 - 2.0 * margin / resolution);
  glm::dmat2 const to_square(1.0 / frame.width, 0.0, 0.0, 1.0 / frame.height);
  glm::dmat2 const turn = turn_by(lay.slope);
  glm::dmat2 const turned = turn * to_square;
  glm::dvec2 const size = outline_bounds(frame, outline, turned).size();
  glm::dmat2 const scale(filled / size.x, 0.0, 0.0, filled / size.y);
  TileMap map;
  if (lay.stretch == 1.0) {
    map.matrix = scale * turned;
  } else {
    glm::dmat2 const stretched =
        scale * turn * glm::dmat2(lay.stretch, 0.0, 0.0, 1.0 / lay.stretch) * to_square;
    glm::dvec2 const across = outline_bounds(frame, outline, stretched).size();
    map.matrix = std::min(1.0, filled / std::max(across.x, across.y)) * stretched;
  }
  map.offset = -outline_bounds(frame, outline, map.matrix).middle();
  return map;
}

View view_of_plane(PlaneFrame const& frame, TileMap const& map) {
  return view_along(frame.u, frame.v, frame, map);
}

View view_in_front(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun) {
  View view = slide(frame, map, towards_sun);
  view.cut = glm::dvec4(frame.normal, 0.0);
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
