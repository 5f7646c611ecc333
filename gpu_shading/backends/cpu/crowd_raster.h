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

// Casters that are projected at once, and boxes that are looked at.
inline constexpr std::size_t crowd_lanes = 8;
// So many points, by axis.
using CrowdPoints = std::array<std::array<double, crowd_lanes>, 3>;
// The corners of so many casters.
using CrowdCorners = std::array<CrowdPoints, 4>;

// So many boxes along the axes.
struct CrowdBoxes {
  CrowdPoints centre{};
  CrowdPoints reach{};
};

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

  // A branch by its index, or a leaf by `leaf` and its index.
  using Node = std::uint32_t;
  static constexpr Node leaf = Node{1} << 31U;

  struct alignas(64) Branch {
    CrowdBoxes boxes;
    std::array<Node, crowd_lanes> children{};
    std::uint32_t count = 0;
  };

  // What a search reads of its casters lies together in memory.
  struct alignas(64) Leaf {
    CrowdCorners corners{};
    std::array<bool, crowd_lanes> several{};  // more than one piece
    std::array<bool, crowd_lanes> only_turned_away{};
    std::uint32_t first = 0;  // position in the casters' tree
    std::uint32_t count = 0;
  };

  // Adds what is below a node of the casters' tree.
  Node add(std::uint32_t of_tree);
  Node add_leaf(Bvh::Node const& of_tree);
  // Nodes that together have all casters, so many or more if there are.
  std::vector<Node> nodes(std::size_t count) const;
  void darken_below(Search& search, Node root) const;
  void darken(Search& search, Leaf const& some) const;
  // Calls use(area) for the pieces of a caster that may shade the receiver.
  template <typename Use>
  void each_area(Search const& search, std::uint32_t position, Use use) const;

  Scene const& scene_;
  Casters const& casters_;
  SurfacePieces const& pieces_;
  Node root_ = 0;
  std::vector<Branch> branches_;
  std::vector<Leaf> leaves_;
};

}  // namespace gpu_shading
