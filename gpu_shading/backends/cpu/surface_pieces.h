#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "geometry/convex_area.h"
#include "geometry/triangulation.h"
#include "gpu_shading/scene.h"
#include "view/range.h"
#include "view/view.h"

namespace gpu_shading {

// The depth of a flat piece by pixel.
struct DepthPlane {
  glm::dvec2 slope{0.0};  // by column and row
  double start = 0.0;     // at the corner of the tile
  // Depths of the piece's corners. The middle of a pixel that it covers may be outside by rounding,
  // which a piece seen nearly from its edge makes a large difference of depth.
  double nearest = 0.0;
  double farthest = 0.0;

  // In the middle of a pixel.
  double at(int column, int row) const {
    double const depth = slope.x * (column + 0.5) + slope.y * (row + 0.5) + start;
    return std::clamp(depth, nearest, farthest);
  }
};

// A convex piece of a surface, projected by a view.
class ProjectedPiece {
 public:
  // Three or four corners, and a view with its x and y in pixels; both must outlive this object.
  ProjectedPiece(std::span<glm::dvec3 const> corners, View const& pixels)
      : corners_(corners), pixels_(pixels) {}

  // What is in front of the view's cut.
  ConvexArea area(int side) const;
  DepthPlane depth() const;

 private:
  glm::dvec2 place(std::size_t corner) const {
    glm::dvec3 const p = corners_[corner] - pixels_.origin;
    return {at(pixels_.x, p), at(pixels_.y, p)};
  }

  std::span<glm::dvec3 const> corners_;
  View const& pixels_;
};

// A scene's surfaces as convex pieces.
class SurfacePieces {
 public:
  // `meshes`: of all surfaces, by id; not referenced later.
  explicit SurfacePieces(std::span<Mesh const> meshes);

  // Calls use(ProjectedPiece) for each piece of a surface.
  template <typename Use>
  void each(SurfaceId id, View const& pixels, Use use) const {
    for (std::size_t i = 0; i < ranges_[id].count; ++i) {
      Piece const& piece = pieces_[ranges_[id].first + i];
      use(ProjectedPiece({piece.corners.data(), piece.count}, pixels));
    }
  }

  // The four corners of a surface that is one piece, the last two of them equal if it has three;
  // none for others.
  std::span<glm::dvec3 const> corners_of_only_piece(SurfaceId id) const {
    if (ranges_[id].count != 1) return {};
    return pieces_[ranges_[id].first].corners;
  }

 private:
  // Corners are stored with each piece: read one after another, they come from memory faster than
  // by way of indices.
  struct Piece {
    std::array<glm::dvec3, 4> corners;
    std::size_t count;
  };

  std::vector<Piece> pieces_;
  std::vector<Range> ranges_;  // of pieces_, by surface
};

}  // namespace gpu_shading
