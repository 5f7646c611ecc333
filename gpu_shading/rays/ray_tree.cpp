#include "rays/ray_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "gpu_shading/error.h"

namespace gpu_shading {

namespace {

bool is_finite(glm::dvec3 const& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string text(glm::dvec3 const& v) {
  return fmt::format("{:.9g}, {:.9g}, {:.9g}", v.x, v.y, v.z);
}

// Of unit length. Those that are, within rounding, are left as they are.
glm::dvec3 unit(glm::dvec3 const& direction) {
  double const square = glm::dot(direction, direction);
  constexpr double rounding = 1e-14;
  if (std::abs(square - 1.0) < rounding) return direction;
  // The square of a very short or very long one is not a number to divide by.
  double const most =
      std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  if (!is_finite(direction) || most == 0.0) {
    throw Error(fmt::format("a ray's direction is ({}), expected finite numbers that are not all 0",
                            text(direction)));
  }
  return glm::normalize(direction / most);
}

}  // namespace

RayPath::RayPath(Ray const& ray)
    : origin(ray.origin), direction(unit(ray.direction)), length(ray.length) {
  if (!is_finite(origin)) {
    throw Error(fmt::format("a ray's origin is ({}), expected finite numbers", text(origin)));
  }
  if (std::isnan(length)) throw Error("a ray's length is not a number");
  glm::dvec3 const size = glm::abs(direction);
  int const longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::array<int, 3> const order{(longest + 1) % 3, (longest + 2) % 3, longest};
  for (std::size_t i = 0; i < order.size(); ++i) {
    axes[i] = static_cast<std::size_t>(order[i]);
  }
  move_to(origin);
  double const each = 1.0 / direction[longest];
  shear = {direction[order[0]] * each, direction[order[1]] * each};
}

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
