#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace gpu_shading {

// Along the axes, in metres. Empty until it includes something.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void include(glm::dvec3 const& point);
  void include(Box const& other);
  bool empty() const { return low.x > high.x; }
  glm::dvec3 centre() const { return 0.5 * (low + high); }
  glm::dvec3 reach() const { return 0.5 * (high - low); }  // from the centre, along each axis
};

// How much of a box lies in the region searched for.
enum class Containment { outside, intersecting, inside };

// A bounding volume hierarchy: a binary tree of boxes, halved at the median of the longest side of
// their centres' bounds, so that a search looks at few boxes outside of its region, and not into
// those inside of it.
class Bvh {
 public:
  Bvh() = default;
  // Ignores empty boxes.
  explicit Bvh(std::vector<Box> const& boxes);

  // The boxes' numbers in the order in which the tree has them: nearly those that lie together.
  std::vector<std::uint32_t> const& order() const { return order_; }

  struct Node {
    glm::dvec3 centre{0.0};
    glm::dvec3 reach{0.0};
    std::uint32_t first = 0;  // of order()
    std::uint32_t count = 0;
    std::uint32_t children = 0;  // the first of two, of more than one
  };
  // From the root on.
  std::vector<Node> const& nodes() const { return nodes_; }

  // Calls found(first, count, containment), of positions in order(), for boxes that are not outside
  // the region: single boxes that intersect it, and runs of boxes that are inside. classify(centre,
  // half extents) returns the Containment of a box; it must not be outside where that of a box
  // within it is not, nor inside where that of a box within it is not.
  template <typename Classify, typename Found>
  void search(Classify const& classify, Found const& found) const {
    if (nodes_.empty()) return;
    // Halving 2^32 boxes goes no deeper.
    std::uint32_t waiting[64];
    int count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      Node const& node = nodes_[waiting[--count]];
      Containment const containment = classify(node.centre, node.reach);
      if (containment == Containment::outside) continue;
      if (containment == Containment::inside || node.count == 1) {
        found(node.first, node.count, containment);
      } else {
        waiting[count++] = node.children;
        waiting[count++] = node.children + 1;
      }
    }
  }

 private:
  void build(std::uint32_t node, std::vector<Box> const& boxes, std::uint32_t first,
             std::uint32_t count);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace gpu_shading
