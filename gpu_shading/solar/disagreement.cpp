#include "solar/disagreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace gpu_shading {
namespace {

double chord_squared(glm::dvec3 const& a, glm::dvec3 const& b) { return glm::dot(a - b, a - b); }

constexpr std::size_t nearby = 4;

struct Candidate {
  HourDirection direction;
  glm::dvec3 towards_sun{};
  std::array<std::size_t, nearby> samples{};  // nearest first
  double distance_squared = 0.0;              // to the nearest existing direction
  double misses = 0.0;
};

Candidate candidate_at(HourDirection direction, double latitude, SunlitTable const& table) {
  Candidate candidate{direction, to_vector(to_direction(direction, latitude))};
  auto const& known = table.towards_sun();
  std::vector<std::size_t> order(known.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  auto const distance = [&](std::size_t i) {
    return chord_squared(known[i], candidate.towards_sun);
  };
  std::partial_sort_copy(order.begin(), order.end(), candidate.samples.begin(),
                         candidate.samples.end(),
                         [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
  candidate.distance_squared = distance(candidate.samples.front());
  return candidate;
}

// Mean of the receivers' errors at samples near the candidate at which the sun faces them.
double misses_near(Candidate const& candidate, SunlitTable const& table, Misses const& misses) {
  // The size of a jump does not depend on how finely it is sampled.
  constexpr double most = 0.1;
  double sum = 0.0;
  for (std::size_t receiver = 0; receiver < table.receivers(); ++receiver) {
    if (!table.faces(receiver, candidate.towards_sun)) continue;
    double total = 0.0;
    int lit = 0;
    for (auto const sample : candidate.samples) {
      if (!table.lit(receiver)[sample]) continue;
      total += misses[receiver][sample];
      ++lit;
    }
    if (lit > 0) sum += std::min(total / lit, most);
  }
  return sum;
}

// The square root of the number of days per year that the sun spends near a declination, relative
// to an equinox.
double weight_of(double declination) {
  constexpr double least = 0.02;
  double const share = declination / most_declination;
  return 1.0 / std::pow(std::max(1.0 - share * share, least), 0.25);
}

}  // namespace

std::vector<HourDirection> where_samples_disagree(SunlitTable const& table, Misses const& misses,
                                                  double latitude, std::size_t count) {
  constexpr std::size_t looked_at = 2500;
  std::vector<Candidate> candidates;
  if (table.directions().size() < nearby) return {};
  for (auto const direction : spread_on_arcs(latitude, looked_at)) {
    auto candidate = candidate_at(direction, latitude, table);
    candidate.misses = misses_near(candidate, table, misses) * weight_of(direction.declination);
    candidates.push_back(candidate);
  }
  // If nothing disagrees, choose where samples are farthest apart.
  constexpr double background = 1e-6;
  std::vector<HourDirection> chosen;
  while (chosen.size() < count) {
    auto const score = [](Candidate const& c) {
      return (c.misses + background) * c.distance_squared;
    };
    auto const best = std::max_element(
        candidates.begin(), candidates.end(),
        [&](Candidate const& a, Candidate const& b) { return score(a) < score(b); });
    if (best == candidates.end() || best->distance_squared == 0.0) break;
    auto const found = *best;
    chosen.push_back(found.direction);
    for (auto& c : candidates) {
      c.distance_squared =
          std::min(c.distance_squared, chord_squared(c.towards_sun, found.towards_sun));
    }
  }
  return chosen;
}

}  // namespace gpu_shading
