#pragma once

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "geometry/plane_frame.h"
#include "gpu_shading/scene.h"
#include "scene/turns.h"

namespace gpu_shading {

// The map from a receiver to its tile: clip coordinates (-1 .. 1) = matrix x (u, v) + offset, where
// u and v are in its frame, in metres. The bounding rectangle is first scaled to a square, so that
// long thin receivers get pixels both ways. The square is turned against the pixel grid (TileLay).
// The receiver then fills the tile except for a margin of one pixel.
struct TileMap {
  glm::dmat2 matrix{1.0};
  glm::dvec2 offset{0.0};

  glm::dvec2 operator()(PlaneFrame const& frame, glm::dvec3 const& point) const;
  // Area of a pixel in the receiver's plane, m2.
  double pixel_area(int resolution) const;
};

// How a tile's pixels lie on its receiver.
struct TileLay {
  double slope = turn_slopes.front();  // of the turn
  // By which the square is longer along u and shorter along v, for another lattice of samples,
  // which aliases with other periods. A tile that is stretched has a wider margin, two ways.
  double stretch = 1.0;
  // Of use to grids of other samples alone than the tile's pixels: without a margin.
  bool for_grids = false;
};

TileMap fit_tile(PlaneFrame const& frame, Ring const& outline, int resolution,
                 TileLay const& lay = {});

// An affine view of the scene: each row is a vector to multiply with a point's coordinates relative
// to `origin`, and a constant. z is 0 (nearest) to 1; `cut` keeps points where it is 0 or more.
struct View {
  glm::dvec3 origin{0.0};
  glm::dvec4 x{0.0};
  glm::dvec4 y{0.0};
  glm::dvec4 z{0.0};
  glm::dvec4 cut{0.0, 0.0, 0.0, 1.0};
};

// The value of a row at a point relative to the view's origin.
inline double at(glm::dvec4 const& row, glm::dvec3 const& p) {
  return glm::dot(glm::dvec3(row), p) + row.w;
}

// The receiver's plane itself.
View view_of_plane(PlaneFrame const& frame, TileMap const& map);

// The part of the scene in front of the receiver's plane, projected along the sun's rays onto it,
// at z 0.
View view_in_front(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun);

// The part behind the plane, up to `reach` metres from it, with z increasing with the distance.
View view_behind(PlaneFrame const& frame, TileMap const& map, glm::dvec3 const& towards_sun,
                 double reach);

}  // namespace gpu_shading
