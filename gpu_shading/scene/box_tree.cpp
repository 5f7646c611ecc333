#include "scene/box_tree.h"

#include <algorithm>
#include <glm/common.hpp>

namespace gpu_shading {

void Box::include(glm::dvec3 const& point) {
  low = glm::min(low, point);
  high = glm::max(high, point);
}

void Box::include(Box const& other) {
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

BoxTree::BoxTree(std::vector<Box> const& boxes) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  if (numbers.empty()) return;
  nodes_.reserve(2 * numbers.size());
  nodes_.emplace_back();
  build(0, boxes, numbers.data(), numbers.data() + numbers.size());
}

void BoxTree::build(std::uint32_t node, std::vector<Box> const& boxes, std::uint32_t* begin,
                    std::uint32_t* end) {
  Box box;
  Box centres;
  for (std::uint32_t const* number = begin; number != end; ++number) {
    box.include(boxes[*number]);
    centres.include(boxes[*number].centre());
  }
  nodes_[node].box = box;
  if (end - begin == 1) {
    nodes_[node].next = *begin;
    nodes_[node].leaf = true;
    return;
  }
  glm::dvec3 const reach = centres.reach();
  int const axis = reach.x >= reach.y && reach.x >= reach.z ? 0 : reach.y >= reach.z ? 1 : 2;
  std::uint32_t* const middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
  });
  auto const children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].next = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, boxes, begin, middle);
  build(children + 1, boxes, middle, end);
}

}  // namespace gpu_shading
