#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "geometry/bvh.h"
#include "gpu_shading/rays.h"

namespace gpu_shading {

// A ray, prepared to be tested against boxes and polygons.
struct RayPath {
  // Throws Error if the ray has no direction or a number that is not finite.
  explicit RayPath(Ray const& ray);
  void move_to(glm::dvec3 const& other_origin) {
    origin = other_origin;
    for (std::size_t i = 0; i < axes.size(); ++i) start[i] = origin[static_cast<int>(axes[i])];
  }

  glm::dvec3 origin;
  glm::dvec3 direction;  // of unit length
  double length;

  // The ray's projection along itself onto two axes. The third is the one along which it is
  // longest; `shear` is how far it goes along the others meanwhile.
  std::array<std::size_t, 3> axes;
  std::array<double, 3> start;  // the origin along these axes
  std::array<double, 2> shear;
};

// A bounding volume hierarchy for single rays: that of Bvh, with four boxes at a time in single
// precision and wide enough for its rounding.
class RayTree {
 public:
  RayTree() = default;
  // Empty boxes are ignored.
  explicit RayTree(std::vector<Box> const& boxes);

  // The boxes' numbers in the order in which the tree has them.
  std::vector<std::uint32_t> const& order() const { return order_; }

  // Calls found(position in order()) for boxes that the ray meets no farther than at `limit`, and
  // maybe for some near it. `found` may lower the limit; below 0, the search ends.
  template <typename Found>
  void search(RayPath const& ray, double const& limit, Found const& found) const {
    if (nodes_.empty() || limit < 0.0) return;
    Slabs const slabs(ray, centre_, reach_);
    // Each of at most 32 levels leaves three behind.
    std::array<std::uint32_t, 128> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      std::uint32_t const next = waiting[--count];
      if (next >= leaf) {
        found(next - leaf);
        if (limit < 0.0) return;
        continue;
      }
      Node const& node = nodes_[next];
      Hits const hits = slabs.meet(node, limit);
      for (int i = 0; i < width; ++i) {
        waiting[count] = node.children[static_cast<std::size_t>(i)];
        count += static_cast<std::size_t>(hits[i]);
      }
    }
  }

 private:
  static constexpr int width = 4;
  static constexpr std::uint32_t leaf = 1U << 31U;
  using Lanes [[gnu::vector_size(16)]] = float;
  using Hits [[gnu::vector_size(16)]] = std::int32_t;

  // Along a cache's lines, because a large tree is seldom in the cache.
  struct alignas(64) Node {
    std::array<std::array<Lanes, 3>, 2> sides;  // low and high, from the tree's centre
    std::array<std::uint32_t, width> children;  // nodes or, from `leaf` on, positions in order()
  };

  // A ray against the boxes of nodes.
  class Slabs {
   public:
    Slabs(RayPath const& ray, glm::dvec3 const& centre, double reach) {
      std::array<float, 3> distances;
      for (int axis = 0; axis < 3; ++axis) {
        auto const place = static_cast<std::size_t>(axis);
        auto const along = static_cast<float>(ray.direction[axis]);
        // Times a distance, its inverse is still a number in single precision.
        constexpr float least = 1e-18F;
        inverse_[place] = 1.0F / (std::abs(along) < least ? std::copysign(least, along) : along);
        near_[place] = inverse_[place] < 0.0F ? 1 : 0;
        double const from_centre = ray.origin[axis] - centre[axis];
        origin_[place] = static_cast<float>(from_centre);
        distances[place] = std::abs(origin_[place]);
      }
      float const distance =
          std::max({distances[0], distances[1], distances[2]}) + static_cast<float>(reach);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        margin_[axis] = distance * std::abs(inverse_[axis]) * rounding;
      }
    }

    // 1 for boxes that the ray meets, otherwise 0.
    Hits meet(Node const& node, double limit) const {
      Lanes enters{};
      auto const up_to = static_cast<float>(limit) * (1.0F + rounding);
      Lanes exits = {up_to, up_to, up_to, up_to};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Lanes const near =
            (node.sides[near_[axis]][axis] - origin_[axis]) * inverse_[axis] - margin_[axis];
        Lanes const far =
            (node.sides[1 - near_[axis]][axis] - origin_[axis]) * inverse_[axis] + margin_[axis];
        enters = near > enters ? near : enters;
        exits = far < exits ? far : exits;
      }
      return (enters <= exits) & 1;
    }

   private:
    // More than that of the three operations on each number, and of the numbers themselves.
    static constexpr float rounding = 1e-6F;

    std::array<float, 3> origin_;
    std::array<float, 3> inverse_;
    std::array<float, 3> margin_;
    std::array<std::size_t, 3> near_;  // the side that the ray meets first
  };

  std::uint32_t add(Bvh const& tree, std::uint32_t node);

  glm::dvec3 centre_{0.0};
  double reach_ = 0.0;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace gpu_shading
