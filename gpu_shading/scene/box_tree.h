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

// How much of a box a search wants.
enum class Wanted { none, part, all };

// Boxes in a binary tree, halved at the median of their longest side, so that a search looks at few
// that it does not want, and not into those that it wants all of.
class BoxTree {
 public:
  BoxTree() = default;
  // Empty boxes are left out.
  explicit BoxTree(std::vector<Box> const& boxes);

  // Calls found(number of a box, how much of it is wanted) for each box that is wanted itself and
  // within wanted boxes all the way up: wanted(centre, reach) says of a box how much of it is, and
  // must not be none of a box when it is not of one within it, nor all when it is not of each.
  template <typename HowMuch, typename Found>
  void search(HowMuch const& wanted, Found const& found) const {
    if (nodes_.empty()) return;
    // Halving 2^32 boxes goes no deeper.
    std::uint32_t waiting[64];
    int count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      Node const& node = nodes_[waiting[--count]];
      Wanted const how_much = wanted(node.centre, node.reach);
      if (how_much == Wanted::none) continue;
      if (how_much == Wanted::all || node.count == 1) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
          found(numbers_[i], how_much);
        }
      } else {
        waiting[count++] = node.children;
        waiting[count++] = node.children + 1;
      }
    }
  }

 private:
  struct Node {
    glm::dvec3 centre{0.0};
    glm::dvec3 reach{0.0};
    std::uint32_t first = 0;     // of numbers_
    std::uint32_t count = 0;     // of them
    std::uint32_t children = 0;  // the first of two, of more than one
  };

  void build(std::uint32_t node, std::vector<Box> const& boxes, std::uint32_t first,
             std::uint32_t count);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> numbers_;  // of the boxes, as the tree has them
};

}  // namespace gpu_shading
