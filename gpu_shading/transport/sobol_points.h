#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gpu_shading {

// The first points of Sobol's sequence, with the direction numbers of Joe and Kuo (2008).
class SobolPoints {
 public:
  SobolPoints(std::size_t count, std::size_t dimensions);

  std::size_t count() const { return count_; }

  // A coordinate with Owen's scrambling, by the hash of Laine and Karras (2011), 0 .. 1 without 1.
  // Dimensions, and seeds, are scrambled independently.
  double at(std::size_t point, std::size_t dimension, std::uint32_t seed) const;

 private:
  std::size_t count_;
  std::size_t dimensions_;
  std::vector<std::uint32_t> bits_;  // reversed, by point
};

// Independent numbers from a key, 0 .. 1 without 1 (splitmix64, Steele, Lea and Flood 2014).
double random_at(std::uint64_t key);

}  // namespace gpu_shading
