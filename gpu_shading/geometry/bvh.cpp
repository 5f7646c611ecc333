#include "geometry/bvh.h"

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

Bvh::Bvh(std::vector<Box> const& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) order_.push_back(static_cast<std::uint32_t>(i));
  }
  if (order_.empty()) return;
  nodes_.reserve(2 * order_.size());
  nodes_.emplace_back();
  build(0, boxes, 0, static_cast<std::uint32_t>(order_.size()));
}

void Bvh::build(std::uint32_t node, std::vector<Box> const& boxes, std::uint32_t first,
                std::uint32_t count) {
  auto const begin = order_.begin() + first;
  auto const end = begin + count;
  Box box;
  Box centres;
  for (auto number = begin; number != end; ++number) {
    box.include(boxes[*number]);
    centres.include(boxes[*number].centre());
  }
  nodes_[node] = {box.centre(), box.reach(), first, count, 0};
  if (count == 1) return;
  glm::dvec3 const reach = centres.reach();
  int const axis = reach.x >= reach.y && reach.x >= reach.z ? 0 : reach.y >= reach.z ? 1 : 2;
  std::uint32_t const half = count / 2;
  std::nth_element(begin, begin + half, end, [&](std::uint32_t a, std::uint32_t b) {
    return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
  });
  auto const children = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].children = children;
  nodes_.resize(nodes_.size() + 2);
  build(children, boxes, first, half);
  build(children + 1, boxes, first + half, count - half);
}

}  // namespace gpu_shading
