#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "backends/cpu/surface_pieces.h"
#include "geometry/bvh.h"
#include "gpu_shading/scene.h"
#include "scene/casters.h"
#include "view/pixel_mask.h"
#include "view/view.h"

namespace gpu_shading {

// Casters that are projected at once.
inline constexpr std::size_t crowd_lanes = 8;
// The corners of so many casters, by corner and axis.
using CrowdCorners = std::array<std::array<std::array<double, crowd_lanes>, 3>, 4>;

// The question for which a crowd of casters is searched.
struct CrowdQuestion {
  SurfaceId receiver = 0;
  glm::dvec3 towards_sun{0.0};
};

// Rasterises opaque casters where they are many, in one search of their tree. Corners are stored in
// the tree's order, and projected for eight casters at once; nodes that meet no lit sample are
// passed over.
class CrowdRaster {
 public:
  // All must outlive it.
  CrowdRaster(Scene const& scene, Casters const& casters, SurfacePieces const& pieces);

  // Takes the samples that some caster covers from a mask. `pixels`: the view in front of the
  // receiver, with x and y in pixels of a grid of up to `side` columns and rows. On so many threads
  // at most.
  void darken(PixelMask& mask, int side, View const& pixels, CrowdQuestion const& question,
              int threads) const;

 private:
  struct Search;

  // The casters of a leaf: what a search reads of them lies together in memory.
  struct alignas(64) Block {
    CrowdCorners corners{};
    std::array<bool, crowd_lanes> several{};  // more than one piece
    std::array<bool, crowd_lanes> only_turned_away{};
  };

  void darken_below(Search& search, std::uint32_t root) const;
  static void prefetch(Block const& block);
  void darken_some(Search& search, std::uint32_t leaf) const;
  // Calls use(area) for the pieces of a caster that may shade the receiver.
  template <typename Use>
  void each_area(Search const& search, std::uint32_t position, Use use) const;

  Scene const& scene_;
  Casters const& casters_;
  SurfacePieces const& pieces_;
  std::vector<Bvh::Node> nodes_;  // with more casters, and leaves, whose `children` is a block
  std::vector<Block> blocks_;
};

}  // namespace gpu_shading
