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

// The hits of paths, in an order in which neighbours are alike: by normal, those on the receiver
// apart, then along a space-filling curve as seen from the receiver.
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
  // The hit at which the sum of weights exceeds this one.
  std::size_t at_weight(double weight) const;

  std::vector<KeptHit> hits_;
  std::vector<double> up_to_;        // the sum of weights before each hit, and of all
  std::vector<std::size_t> groups_;  // the first hit of each group, and the number of hits
  // By as many equal parts of the weight as there are hits, the hit at which each begins (the guide
  // table of Chen and Asau, 1974).
  std::vector<std::size_t> guide_;
};

}  // namespace gpu_shading
