#include "calculation/step_error.h"

#include <algorithm>
#include <cmath>

namespace gpu_shading::energyplus {
namespace {

constexpr std::size_t max_samples = 32;
// Of a step, below which a position counts as exact.
constexpr double negligible = 1e-6;

}  // namespace

void StepError::note(SunDirection sun, std::vector<double> const& stood,
                     std::vector<double> const& exact) {
  Sample sample{sun, stood, stood};
  for (std::size_t i = 0; i < shades_.size(); ++i) {
    auto const& shade = shades_[i];
    double const off = exact[i] - stood[i];
    if (std::abs(off) <= negligible * shade.step) continue;
    double const beyond =
        std::clamp(stood[i] + std::copysign(shade.step, off), shade.minimum, shade.maximum);
    if (beyond == stood[i]) continue;
    sample.beyond[i] = beyond;
    sample.share = std::max(sample.share, std::min(off / (beyond - stood[i]), 1.0));
  }
  if (sample.share <= 0.0) return;
  if (noted_++ % stride_ != 0) return;
  samples_.push_back(std::move(sample));
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
    auto const here = fractions(sample.sun, sample.stood);
    auto const there = fractions(sample.sun, sample.beyond);
    double most = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      most = std::max(most, sample.share * std::abs(there[i] - here[i]));
    }
    found.mean += most;
    found.most = std::max(found.most, most);
  }
  found.timesteps = samples_.size();
  found.mean /= static_cast<double>(found.timesteps);
  return found;
}

}  // namespace gpu_shading::energyplus
