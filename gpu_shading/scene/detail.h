#pragma once

namespace gpu_shading {

// Length of the shadow edges that cross a receiver's bounding rectangle, including hidden ones, in
// lengths of the rectangle's side along which they run, so that an edge from end to end counts 1.
struct Detail {
  double along = 0.0;   // parallel to the rectangle's sides
  double across = 0.0;  // all others

  double total() const { return along + across; }
  Detail& operator+=(Detail const& other) {
    along += other.along;
    across += other.across;
    return *this;
  }
};

inline Detail operator*(double factor, Detail const& detail) {
  return {factor * detail.along, factor * detail.across};
}

}  // namespace gpu_shading
