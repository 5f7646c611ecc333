#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "transport/mirrors.h"
#include "transport/reverse_paths.h"

namespace gpu_shading {

// A hit that was drawn for one of several directions.
struct DrawnHit {
  KeptHit const* hit = nullptr;
  std::size_t direction = 0;
  // Irradiance of the receiver, if a beam of 1 W/m2 from there reaches the hit.
  double weight = 0.0;
};

// The hits of paths, in an order in which neighbours are alike: by normal, then along a
// space-filling curve as seen from the receiver.
class HitPool {
 public:
  // `paths`: how many the hits come from. Distances from `centre` beyond `size` count by their
  // logarithm.
  HitPool(std::vector<KeptHit> hits, std::size_t paths, glm::dvec3 const& centre, double size);

  // Drawn systematically in proportion to weight times cosine times the direction's share. None if
  // all face away. `key`: of the random start.
  std::vector<DrawnHit> draw(std::span<LightDirection const> directions, int draws,
                             std::uint64_t key) const;

 private:
  std::vector<KeptHit> hits_;
  std::vector<double> up_to_;        // the sum of weights before each hit, and of all
  std::vector<std::size_t> groups_;  // the first hit of each normal, and the number of hits
};

}  // namespace gpu_shading
