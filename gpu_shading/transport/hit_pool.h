#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "transport/reverse_paths.h"

namespace gpu_shading {

// Irradiance of the receiver for a beam of 1 W/m2.
struct PooledBeam {
  LightByGround light;
  std::size_t rays = 0;
};

// The hits of paths, in an order in which neighbours are alike: by normal, then along a
// space-filling curve as seen from the receiver.
class HitPool {
 public:
  // `paths`: how many the hits come from. Distances from `centre` beyond `size` count by their
  // logarithm.
  HitPool(std::vector<KeptHit> hits, std::size_t paths, glm::dvec3 const& centre, double size);

  // By shadow rays from `draws` hits, drawn systematically in proportion to weight times cosine.
  // `key`: of the random start.
  PooledBeam beam(RayScene const& rays, RayConditions const& conditions, glm::dvec3 const& sun,
                  int draws, std::uint64_t key) const;

 private:
  std::vector<KeptHit> hits_;
  std::vector<double> up_to_;        // the sum of weights before each hit, and of all
  std::vector<std::size_t> groups_;  // the first hit of each normal, and the number of hits
};

}  // namespace gpu_shading
