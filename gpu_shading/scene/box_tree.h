#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace gpu_shading {

// Along the axes, in metres. Empty as it begins.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void include(glm::dvec3 const& point);
  void include(Box const& other);
  bool empty() const { return low.x > high.x; }
  glm::dvec3 centre() const { return 0.5 * (low + high); }
  glm::dvec3 reach() const { return 0.5 * (high - low); }  // from the centre, along each axis
};

// Boxes in a binary tree, halved at the median of their longest side, so that a search looks at few
// that it does not want.
class BoxTree {
 public:
  BoxTree() = default;
  // Empty boxes are left out.
  explicit BoxTree(std::vector<Box> const& boxes);

  // Calls found(number of a box) for each box that is wanted itself and within wanted boxes all the
  // way up: wanted(box) must be true of a box when it is true of a box within it.
  template <typename Wanted, typename Found>
  void search(Wanted const& wanted, Found const& found) const {
    if (nodes_.empty()) return;
    // Halving 2^32 boxes goes no deeper.
    std::uint32_t waiting[64];
    int count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      Node const& node = nodes_[waiting[--count]];
      if (!wanted(node.box)) continue;
      if (node.leaf) {
        found(node.next);
      } else {
        waiting[count++] = node.next;
        waiting[count++] = node.next + 1;
      }
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t next = 0;  // first of two children, or the number of a box
    bool leaf = false;
  };

  void build(std::uint32_t node, std::vector<Box> const& boxes, std::uint32_t* begin,
             std::uint32_t* end);

  std::vector<Node> nodes_;
};

}  // namespace gpu_shading
