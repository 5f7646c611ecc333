#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gpu_shading/scene.h"
#include "scene/triangulation.h"
#include "view/convex_area.h"
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

// A convex piece of a surface as a view has it.
class ProjectedPiece {
 public:
  // Three or four corners; `pixels` has its x and y in pixels.
  ProjectedPiece(std::span<glm::dvec3 const> corners, View const& pixels) : count_(corners.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      glm::dvec3 const p = corners[i] - pixels.origin;
      corners_[i] = {at(pixels.x, p), at(pixels.y, p)};
      depths_[i] = at(pixels.z, p);
      distances_[i] = at(pixels.cut, p);
    }
  }

  // What is in front of the view's cut.
  ConvexArea area(int side) const {
    return area_in_front({corners_.data(), count_}, {distances_.data(), count_}, side);
  }
  DepthPlane depth() const;

 private:
  std::size_t count_;
  std::array<glm::dvec2, 4> corners_;
  std::array<double, 4> depths_;
  std::array<double, 4> distances_;
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
      glm::uvec4 const& piece = pieces_[ranges_[id].first + i];
      std::array const corners{points_[piece[0]], points_[piece[1]], points_[piece[2]],
                               points_[piece[3]]};
      std::size_t const count = piece[2] == piece[3] ? 3 : 4;
      use(ProjectedPiece({corners.data(), count}, pixels));
    }
  }

 private:
  std::vector<glm::dvec3> points_;
  std::vector<glm::uvec4> pieces_;  // corners; the last one twice if there are three
  std::vector<Range> ranges_;       // of pieces_, by surface
};

}  // namespace gpu_shading
