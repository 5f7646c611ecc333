#include "transport/sobol_points.h"

#include <boost/random/sobol.hpp>

namespace gpu_shading {
namespace {

constexpr int word = 32;

std::uint32_t reversed(std::uint32_t x) {
  x = (x >> 1U & 0x55555555U) | (x & 0x55555555U) << 1U;
  x = (x >> 2U & 0x33333333U) | (x & 0x33333333U) << 2U;
  x = (x >> 4U & 0x0f0f0f0fU) | (x & 0x0f0f0f0fU) << 4U;
  x = (x >> 8U & 0x00ff00ffU) | (x & 0x00ff00ffU) << 8U;
  return x >> 16U | x << 16U;
}

std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30U) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27U) * 0x94d049bb133111ebU;
  return x ^ x >> 31U;
}

}  // namespace

SobolPoints::SobolPoints(std::size_t count, std::size_t dimensions)
    : count_(count), dimensions_(dimensions), bits_(count * dimensions) {
  // The library leaves out the first point, 0.
  boost::random::sobol_engine<std::uint32_t, word> sequence(dimensions);
  for (std::size_t i = dimensions; i < bits_.size(); ++i) bits_[i] = reversed(sequence());
}

double SobolPoints::at(std::size_t point, std::size_t dimension, std::uint32_t seed) const {
  auto x = bits_[point * dimensions_ + dimension];
  x += static_cast<std::uint32_t>(mixed(std::uint64_t{seed} << 32U | dimension));
  for (std::uint32_t const factor : {0x6c50b47cU, 0xb82f1e52U, 0xc7afe638U, 0x8d22f6e6U}) {
    x ^= x * factor;
  }
  return reversed(x) * 0x1p-32;
}

double random_at(std::uint64_t key) { return static_cast<double>(mixed(key) >> 11U) * 0x1p-53; }

}  // namespace gpu_shading
