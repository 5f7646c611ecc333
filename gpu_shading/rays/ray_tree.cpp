#include "rays/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace gpu_shading {
namespace {

double largest(glm::dvec3 const& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

double half_area(Bvh::Node const& node) {
  glm::dvec3 const& r = node.reach;
  return r.x * r.y + r.y * r.z + r.z * r.x;
}

// Not to the nearest.
float rounded_down(double x) {
  auto const rounded = static_cast<float>(x);
  return static_cast<double>(rounded) > x
             ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
             : rounded;
}
float rounded_up(double x) { return -rounded_down(-x); }

}  // namespace

RayTree::RayTree(std::vector<Box> const& boxes) {
  Bvh const tree(boxes);
  order_ = tree.order();
  if (order_.empty()) return;
  centre_ = tree.nodes().front().centre;
  reach_ = largest(tree.nodes().front().reach);
  nodes_.reserve(order_.size());
  add(tree, 0);
}

std::uint32_t RayTree::add(Bvh const& tree, std::uint32_t node) {
  std::vector<std::uint32_t> parts{node};
  // The largest is the likeliest to be met, and opened.
  while (parts.size() < width) {
    auto const largest_part =
        std::max_element(parts.begin(), parts.end(), [&](std::uint32_t a, std::uint32_t b) {
          auto const size = [&](std::uint32_t part) {
            Bvh::Node const& of = tree.nodes()[part];
            return of.count == 1 ? -1.0 : half_area(of);
          };
          return size(a) < size(b);
        });
    Bvh::Node const& opened = tree.nodes()[*largest_part];
    if (opened.count == 1) break;
    *largest_part = opened.children;
    parts.push_back(opened.children + 1);
  }
  auto const number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Node made{};
  for (int i = 0; i < width; ++i) {
    auto const place = static_cast<std::size_t>(i);
    bool const is_part = place < parts.size();
    Bvh::Node const part = is_part ? tree.nodes()[parts[place]] : Bvh::Node{};
    for (int axis = 0; axis < 3; ++axis) {
      double const middle = part.centre[axis] - centre_[axis];
      // No ray meets a box whose sides are the wrong way round.
      constexpr double none = 1e30;
      double const half = is_part ? part.reach[axis] : -none;
      auto const along = static_cast<std::size_t>(axis);
      made.sides[0][along][i] = rounded_down(middle - half);
      made.sides[1][along][i] = rounded_up(middle + half);
    }
    if (!is_part) continue;
    made.children[place] = part.count == 1 ? leaf + part.first : add(tree, parts[place]);
  }
  nodes_[number] = made;
  return number;
}

}  // namespace gpu_shading
