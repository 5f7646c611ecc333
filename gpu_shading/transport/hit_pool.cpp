#include "transport/hit_pool.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

namespace gpu_shading {
namespace {

constexpr int curve_bits = 21;  // of each axis

// Bits of a number of curve_bits, two places apart.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffffU;
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

// Places along Morton's curve, with distances by their logarithm.
std::vector<std::uint64_t> along_curve(std::vector<KeptHit> const& hits, glm::dvec3 const& centre,
                                       double size) {
  std::vector<glm::dvec3> places;
  places.reserve(hits.size());
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (auto const& hit : hits) {
    auto place = hit.point - centre;
    double const far = glm::length(place);
    if (far > size) place *= (1.0 + std::log(far / size)) * size / far;
    low = glm::min(low, place);
    high = glm::max(high, place);
    places.push_back(place);
  }
  auto const extent = high - low;
  double const scale = ((1U << curve_bits) - 1) / std::max({extent.x, extent.y, extent.z, 1e-9});
  std::vector<std::uint64_t> keys;
  keys.reserve(places.size());
  for (auto const& place : places) {
    auto const cell = (place - low) * scale;
    auto const axis = [](double value) { return spread(static_cast<std::uint64_t>(value)); };
    keys.push_back(axis(cell.x) | axis(cell.y) << 1U | axis(cell.z) << 2U);
  }
  return keys;
}

struct Place {
  std::pair<bool, std::uint64_t> group;  // on the receiver, and the normal's key
  std::uint64_t along;
  std::size_t hit;
};

}  // namespace

HitPool::HitPool(std::vector<KeptHit> hits, std::size_t paths, glm::dvec3 const& centre,
                 double size) {
  auto const keys = along_curve(hits, centre, size);
  std::vector<Place> order;
  order.reserve(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    order.push_back({{hits[i].on_receiver, normal_key(hits[i].normal)}, keys[i], i});
  }
  std::ranges::sort(order, {}, [](Place const& place) {
    return std::tuple(place.group, place.along, place.hit);
  });
  hits_.reserve(hits.size());
  up_to_.reserve(hits.size() + 1);
  up_to_.push_back(0.0);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || order[i].group != order[i - 1].group) groups_.push_back(i);
    hits_.push_back(hits[order[i].hit]);
    up_to_.push_back(up_to_.back() + hits_.back().weight / static_cast<double>(paths));
  }
  groups_.push_back(hits_.size());
  std::size_t at = 0;
  for (std::size_t part = 0; part < hits_.size(); ++part) {
    double const weight = up_to_.back() * static_cast<double>(part) / double(hits_.size());
    while (at + 1 < hits_.size() && up_to_[at + 1] <= weight) ++at;
    guide_.push_back(at);
  }
}

std::size_t HitPool::at_weight(double weight) const {
  auto const part = static_cast<std::size_t>(weight / up_to_.back() * double(guide_.size()));
  std::size_t at = guide_[std::min(part, guide_.size() - 1)];
  while (at > 0 && up_to_[at] > weight) --at;
  while (at + 1 < hits_.size() && up_to_[at + 1] <= weight) ++at;
  return at;
}

std::vector<DrawnHit> HitPool::draw(std::span<LightDirection const> directions, int draws,
                                    std::uint64_t key) const {
  // Share times weight times cosine up to the end of each group, by direction.
  std::size_t const groups = groups_.size() - 1;
  std::vector<double> sums;
  sums.reserve(directions.size() * groups);
  double total = 0.0;
  for (auto const& direction : directions) {
    for (std::size_t g = 0; g < groups; ++g) {
      auto const& first = hits_[groups_[g]];
      double const cosine = first.on_receiver && !direction.by_mirror
                                ? 0.0
                                : std::max(0.0, glm::dot(first.normal, direction.towards));
      total += direction.share * cosine * (up_to_[groups_[g + 1]] - up_to_[groups_[g]]);
      sums.push_back(total);
    }
  }
  std::vector<DrawnHit> drawn;
  if (groups == 0 || total <= 0.0) return drawn;
  drawn.reserve(static_cast<std::size_t>(draws));
  double const share = total / draws;
  double const start = random_at(key);
  for (int k = 0; k < draws; ++k) {
    double const place = (k + start) * share;
    auto const found = std::upper_bound(sums.begin(), std::prev(sums.end()), place);
    auto const at = static_cast<std::size_t>(found - sums.begin());
    auto const g = at % groups;
    double const before = at == 0 ? 0.0 : sums[at - 1];
    double const within = std::clamp((place - before) / (*found - before), 0.0, 1.0);
    double const weight =
        up_to_[groups_[g]] + within * (up_to_[groups_[g + 1]] - up_to_[groups_[g]]);
    auto const hit = std::clamp(at_weight(weight), groups_[g], groups_[g + 1] - 1);
    drawn.push_back({&hits_[hit], at / groups, share / directions[at / groups].share});
  }
  return drawn;
}

}  // namespace gpu_shading
