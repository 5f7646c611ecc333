#include "calculation/step_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t max_samples = 32;
// Of a step, below which a position counts as exact.
constexpr double negligible = 1e-6;

}  // namespace

std::vector<WeightedPositions> simplex_from(std::vector<double> first,
                                            std::vector<BetweenSteps> between) {
  std::ranges::stable_sort(between, std::greater(), &BetweenSteps::share);
  std::vector<WeightedPositions> corners{{std::move(first)}};
  for (auto const& each : between) {
    corners.back().weight -= each.share;
    corners.push_back({corners.back().positions, each.share});
    corners.back().positions[each.place] = each.next;
  }
  return corners;
}

std::vector<WeightedPositions> around(std::vector<MovingShade> const& shades,
                                      std::vector<double> const& stood,
                                      std::vector<double> const& exact) {
  std::vector<BetweenSteps> between;
  for (std::size_t i = 0; i < shades.size(); ++i) {
    auto const& shade = shades[i];
    double const off = exact[i] - stood[i];
    if (std::abs(off) <= negligible * shade.step) continue;
    double const next = shade.neighbour(stood[i], off > 0.0);
    if (next == stood[i]) continue;
    between.push_back({std::min(off / (next - stood[i]), 1.0), i, next});
  }
  return simplex_from(stood, std::move(between));
}

void StepError::note(SunDirection sun, std::vector<WeightedPositions> const& corners,
                     std::vector<double> const& exact) {
  if (corners.size() < 2) return;
  if (noted_++ % stride_ != 0) return;
  samples_.push_back({sun, corners, exact});
  if (samples_.size() < max_samples) return;
  // Every second one is kept, so that they stay spread over the run.
  for (std::size_t i = 0; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
  samples_.resize((samples_.size() + 1) / 2);
  stride_ *= 2;
}

std::optional<StepError::Estimate> StepError::estimate(Fractions const& fractions) const {
  if (samples_.empty()) return std::nullopt;
  Estimate found;
  for (auto const& sample : samples_) {
    auto errors = fractions(sample.sun, sample.exact);
    for (auto const& [positions, weight] : sample.corners) {
      auto const there = fractions(sample.sun, positions);
      for (std::size_t i = 0; i < errors.size(); ++i) errors[i] -= weight * there[i];
    }
    double most = 0.0;
    for (double const error : errors) most = std::max(most, std::abs(error));
    found.mean += most;
    found.most = std::max(found.most, most);
  }
  found.timesteps = samples_.size();
  found.mean /= static_cast<double>(found.timesteps);
  return found;
}

}  // namespace gpu_shading::energyplus
