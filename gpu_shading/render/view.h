#pragma once

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu_shading/scene.h"
#include "scene/plane_frame.h"

namespace gpu_shading {

// How a receiver lies on its tile: clip coordinates (-1 .. 1) = matrix x (u, v) + offset, of its
// frame's u and v in metres. Its bounding rectangle is made a square first, so that long thin
// receivers get pixels both ways; the square is turned by an angle of golden slope against the
// pixel lattice, the slope worst approximated by fractions, so that edges along u and v (nearly all
// in buildings) meet the pixels' centres evenly; then the receiver fills the tile but for a pixel
// of margin.
struct TileMap {
  glm::dmat2 matrix{1.0};
  glm::dvec2 offset{0.0};

  glm::dvec2 operator()(PlaneFrame const& frame, glm::dvec3 const& point) const;
  // m2 of the receiver's plane that a pixel covers.
  double pixel_area(int resolution) const;
};

TileMap fit_tile(PlaneFrame const& frame, Ring const& outline, int resolution);

// An affine view of the scene: each row a vector to multiply a point's coordinates relative to
// `origin` with, and a constant. z from 0, nearest, to 1; `cut` keeps what gives 0 or more.
struct View {
  glm::dvec3 origin{0.0};
  glm::dvec4 x{0.0};
  glm::dvec4 y{0.0};
  glm::dvec4 z{0.0};
  glm::dvec4 cut{0.0, 0.0, 0.0, 1.0};
};

// What a row gives of a point relative to the view's origin.
inline double at(glm::dvec4 const& row, glm::dvec3 const& p) {
  return glm::dot(glm::dvec3(row), p) + row.w;
}

// What stands in front of the receiver's plane, slid along the sun's rays onto it, at z 0.
View view_in_front(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun);

// What lies behind the plane, up to `reach` metres from it, z growing with the distance.
View view_behind(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun,
                 double reach);

}  // namespace gpu_shading
