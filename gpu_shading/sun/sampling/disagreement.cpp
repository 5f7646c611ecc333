#include "sun/sampling/disagreement.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "platform/parallel.h"

namespace gpu_shading {
namespace {

// Solid angle of the sun's directions above the horizon.
double suns_solid_angle() { return 2.0 * std::numbers::pi * std::sin(max_declination); }

double chord_squared(glm::dvec3 const& a, glm::dvec3 const& b) { return glm::dot(a - b, a - b); }

// Days per year that the sun spends near a declination, relative to an equinox.
double duration_at(double declination) {
  constexpr double min_value = 0.02;
  double const share = declination / max_declination;
  return 1.0 / std::sqrt(std::max(1.0 - share * share, min_value));
}

}  // namespace

Disagreement::Disagreement(SunlitTable const& table, SunlitSplines const& splines, double latitude)
    : table_(table),
      misses_(splines.misses(table)),
      expected_errors_(table.receivers(), 0.0),
      facing_(table.receivers(), 0.0) {
  constexpr std::size_t candidate_count = 2500;
  if (table.directions().size() < nearby) return;
  for (auto const direction : spread_on_arcs(latitude, candidate_count)) {
    candidates_.push_back(candidate_at(direction, latitude, 1.0));
  }
  add_grazing(latitude, candidate_count);
  uncertainty_.resize(candidates_.size());
  for_each_index(candidates_.size(), [&](std::size_t i) {
    uncertainty_[i] = splines.uncertainty(to_direction(candidates_[i].direction, latitude));
  });
  for (std::size_t receiver = 0; receiver < table.receivers(); ++receiver) estimate(receiver);
}

// In front of a receiver's plane by a few degrees or less, shadows are long, and fractions change
// faster than anywhere else. The sun stays there for days on end if the plane is about parallel to
// the equator's: before walls that face north and south at the equator, and over level roofs near
// the poles.
void Disagreement::add_grazing(double latitude, std::size_t evenly_spread) {
  struct Strip {
    double cosine;
    double width;
  };
  constexpr std::array<Strip, 3> strips{{{0.004, 0.006}, {0.015, 0.017}, {0.04, 0.025}}};
  constexpr int steps = 24;
  constexpr double step = 2.0 * std::numbers::pi / steps;
  double const usual = suns_solid_angle() / static_cast<double>(evenly_spread);
  for (auto const& normal : distinct_normals()) {
    glm::dvec3 const axis = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    auto const across = glm::normalize(glm::cross(normal, axis));
    auto const along = glm::cross(normal, across);
    for (auto const [cosine, width] : strips) {
      double const sine = std::sqrt(1.0 - cosine * cosine);
      for (int i = 0; i < steps; ++i) {
        double const turn = (i + 0.5) * step;
        auto const direction = to_direction(
            cosine * normal + sine * (std::cos(turn) * across + std::sin(turn) * along));
        if (direction.altitude <= 0.0) continue;
        auto const hours = to_hour_direction(direction, latitude);
        if (std::abs(hours.declination) > max_declination) continue;
        candidates_.push_back(candidate_at(hours, latitude, width * step / usual));
      }
    }
  }
}

std::vector<glm::dvec3> Disagreement::distinct_normals() const {
  constexpr std::size_t max_count = 12;
  constexpr double alike = 0.9998;  // within a degree
  std::vector<glm::dvec3> normals;
  for (std::size_t i = 0; i < table_.receivers() && normals.size() < max_count; ++i) {
    auto const& normal = table_.normal(i);
    bool const known = std::ranges::any_of(
        normals, [&](glm::dvec3 const& other) { return glm::dot(normal, other) > alike; });
    if (!known && normal != glm::dvec3(0.0)) normals.push_back(normal);
  }
  return normals;
}

Disagreement::Candidate Disagreement::candidate_at(HourDirection direction, double latitude,
                                                   double solid_angle) const {
  Candidate candidate{direction, to_vector(to_direction(direction, latitude))};
  candidate.duration = solid_angle * duration_at(direction.declination);
  auto const& known = table_.towards_sun();
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

// Mean over the samples near the candidate at which the sun faces the receiver; 0 if there is none.
double Disagreement::misses_near(Candidate const& candidate, std::size_t receiver) const {
  // The size of a jump does not depend on how finely it is sampled.
  constexpr double max_miss = 0.2;
  double total = 0.0;
  int lit = 0;
  for (auto const sample : candidate.samples) {
    if (!table_.lit(receiver)[sample]) continue;
    total += misses_[receiver][sample];
    ++lit;
  }
  return lit > 0 ? std::min(total / lit, max_miss) : 0.0;
}

void Disagreement::estimate(std::size_t receiver) {
  double errors = 0.0;
  double faced = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    auto const& candidate = candidates_[i];
    whole += candidate.duration;
    if (!table_.faces(receiver, candidate.towards_sun)) continue;
    faced += candidate.duration;
    errors += candidate.duration * (0.5 * misses_near(candidate, receiver) +
                                    static_cast<double>(uncertainty_[i][receiver]));
  }
  if (faced == 0.0) return;
  expected_errors_[receiver] = errors / faced;
  facing_[receiver] = faced / whole;
}

std::vector<HourDirection> Disagreement::further_directions(std::size_t count,
                                                            double wanted) const {
  if (candidates_.empty()) return {};
  // Splines of all kinds round off a jump alike; then samples miss one another.
  constexpr double share_of_misses = 0.3;
  auto candidates = candidates_;
  std::vector<double> worth(candidates.size(), 0.0);
  for (std::size_t receiver = 0; receiver < table_.receivers(); ++receiver) {
    double const error = expected_errors_[receiver];
    if (facing_[receiver] == 0.0 || error < wanted) continue;
    double const weight = error * error / facing_[receiver];
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (!table_.faces(receiver, candidates[i].towards_sun)) continue;
      worth[i] += weight * (static_cast<double>(uncertainty_[i][receiver]) +
                            share_of_misses * misses_near(candidates[i], receiver));
    }
  }
  // If nothing disagrees, choose where samples are farthest apart.
  constexpr double background = 1e-9;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    worth[i] = (worth[i] + background) * std::sqrt(candidates[i].duration);
  }
  std::vector<HourDirection> chosen;
  while (chosen.size() < count) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (worth[i] * candidates[i].distance_squared >
          worth[best] * candidates[best].distance_squared) {
        best = i;
      }
    }
    if (candidates[best].distance_squared == 0.0) break;
    auto const found = candidates[best];
    chosen.push_back(found.direction);
    for (auto& c : candidates) {
      c.distance_squared =
          std::min(c.distance_squared, chord_squared(c.towards_sun, found.towards_sun));
    }
  }
  return chosen;
}

}  // namespace gpu_shading
